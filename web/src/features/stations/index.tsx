export { StationsPage as default } from "./StationsPage";
