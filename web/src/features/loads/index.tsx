import { LoadListPage } from "./LoadListPage";
import { LoadPage } from "./LoadPage";

export default function LoadsPage({ id }: { id?: string }) {
  return id === undefined ? <LoadListPage /> : <LoadPage key={id} id={id} />;
}
