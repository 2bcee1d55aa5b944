import { VehicleListPage } from "./VehicleListPage";
import { VehiclePage } from "./VehiclePage";
import "./vehicles.css";

export default function VehiclesPage({ id }: { id?: string }) {
  return id === undefined ? <VehicleListPage /> : <VehiclePage key={id} id={id} />;
}
