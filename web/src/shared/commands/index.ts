export { CancelOrder } from "./CancelOrder";
export { CommandFailed } from "./CommandFailed";
export { HeldBar } from "./HeldBar";
export { isOpen } from "./orderState";
export { PauseVehicle } from "./PauseVehicle";
export { useHeldWords } from "./useHeldWords";
export { useOverdue } from "./useOverdue";
export { useRefusal } from "./useRefusal";
