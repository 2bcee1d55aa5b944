import { OrdersPage } from "./OrdersPage";
import "./orders.css";

export default function Orders({ id }: { id?: string }) {
  return <OrdersPage id={id} />;
}
