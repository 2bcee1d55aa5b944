export { SendPage as default } from "./SendPage";
