import { VehicleListPage } from "./VehicleListPage";
import { VehiclePage } from "./VehiclePage";

export default function VehiclesPage({ id }: { id?: string }) {
  return id === undefined ? <VehicleListPage /> : <VehiclePage key={id} id={id} />;
}
