// Looks that the components build on, so that they come before each component's own wherever the bundler puts it.
import "@/shared/styles/tokens.css";
import "@/shared/styles/components.css";
import "@/shared/styles/segmented.css";
import "@/shared/styles/pages.css";
import "@/shared/styles/tables.css";
export { Banner, prioritySymbol, type Priority } from "./Banner";
export { Button, type ButtonProps } from "./Button";
export { Card, type CardProps } from "./Card";
export { CheckRow, sortChecks, type CheckResult } from "./CheckRow";
export { Chip } from "./Chip";
export { CommandButton, type CommandButtonProps } from "./CommandButton";
export { DeviationBar } from "./DeviationBar";
export { type CommandProgress } from "./command";
export { goGuard } from "./goGuard";
export {
  Icon,
  ModeIcon,
  Sprite,
  StatusSymbol,
  type IconName,
  type ModeIconName,
  type SymbolName,
} from "./Icon";
export { PanelEmpty, PanelFailed, PanelLoading } from "./Panel";
export { SearchField } from "./SearchField";
export { Tabs, type TabItem } from "./Tabs";
export { freshness, kLateS, kLostS, Value, type Freshness } from "./Value";
export { NumberPad } from "./NumberPad";
export { VehicleMini } from "./VehicleMini";
