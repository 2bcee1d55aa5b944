import { OrdersPage } from "./OrdersPage";

export default function Orders({ id }: { id?: string }) {
  return <OrdersPage id={id} />;
}
