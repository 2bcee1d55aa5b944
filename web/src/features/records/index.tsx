import { RecordListPage } from "./RecordListPage";
import { RecordPage } from "./RecordPage";

export default function RecordsPage({ id }: { id?: string }) {
  return id === undefined ? <RecordListPage /> : <RecordPage key={id} id={id} />;
}
