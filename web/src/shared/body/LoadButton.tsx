import { useTranslation } from "react-i18next";
import type { Vehicle } from "@/shared/api/types";
import { CommandFailed } from "@/shared/commands";
import { CommandButton } from "@/shared/ui";
import { liftBar } from "./lifts";
import type { Lift } from "./useLift";

interface Props extends Lift {
  label: string;
  vehicle: Vehicle;
  type: "pick" | "drop";
  /** Why commands are off. */
  refused: string | undefined;
}

/** Something about a vehicle's load, in two presses; barred as a transfer of that type is. */
export function LoadButton({ label, vehicle, type, command, progress, refused }: Props) {
  const { t } = useTranslation("body");
  const bar = liftBar(vehicle, type);
  return (
    <>
      <div className="feet">
        <CommandButton
          label={label}
          primary={false}
          direction="go"
          progress={progress}
          disabledReason={refused ?? (bar === undefined ? undefined : t(`lifts.${bar}`))}
          onRun={command.run}
        />
      </div>
      <CommandFailed command={command} />
    </>
  );
}
