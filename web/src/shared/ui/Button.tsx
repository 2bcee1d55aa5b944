import type { ReactNode, Ref } from "react";
import { Icon, type IconName } from "./Icon";

export interface ButtonProps {
  children?: ReactNode;
  icon?: IconName;
  /** Filled blue. One per screen. */
  primary?: boolean;
  /** At least 76 px high: commands that move something. */
  motion?: boolean;
  quiet?: boolean;
  /** Accessible name where the button shows an icon only. */
  label?: string;
  disabled?: boolean;
  pressed?: boolean;
  type?: "button" | "submit";
  className?: string;
  onPress?: () => void;
  ref?: Ref<HTMLButtonElement>;
}

/** A plain button. Two-step commands to vehicles are CommandButton. */
export function Button(props: ButtonProps) {
  const {
    children,
    icon,
    primary,
    motion,
    quiet,
    label,
    disabled,
    pressed,
    type = "button",
    className,
  } = props;
  const classes = [
    "btn",
    primary && "primary",
    motion && "motion",
    quiet && "quiet",
    !children && "icon",
    className,
  ];
  return (
    <button
      ref={props.ref}
      type={type}
      className={classes.filter(Boolean).join(" ")}
      aria-label={label}
      aria-pressed={pressed}
      title={children === undefined ? label : undefined}
      disabled={disabled}
      onClick={props.onPress}
    >
      {icon && <Icon name={icon} />}
      {children}
    </button>
  );
}
