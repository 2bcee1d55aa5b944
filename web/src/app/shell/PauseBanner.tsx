import { useTranslation } from "react-i18next";
import { useHeldWords, useRefusal } from "@/shared/commands";
import { fleetHalt, pausedSingly, useFleet, useServerNow, useVehicles, type FleetHalt } from "@/shared/live";
import { useLocation } from "@/shared/router";
import { Banner, Button, goGuard } from "@/shared/ui";
import { dateTime } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";

/** On every page: who has the fleet or single vehicles stand, since when, and who of them still moves. */
export function PauseBanner({ onResume }: { onResume: () => void }) {
  const { t } = useTranslation(["common", "commands"]);
  const words = useWords();
  const held = useHeldWords();
  const refused = useRefusal();
  const now = useServerNow(60_000);
  const vehicles = useVehicles();
  const halt = fleetHalt(useFleet(), vehicles);
  const singly = pausedSingly(vehicles);
  const names = singly.map((v) => v.name).join(t("common:join"));
  const [first] = singly;
  const { path } = useLocation();
  // On its own page it says so itself, and Pause must not move away under the finger.
  const alone = singly.length === 1 && path === `/vehicles/${encodeURIComponent(first?.id ?? "")}`;
  if (halt === undefined && (first === undefined || alone)) return null;
  const [what, more] = halt !== undefined ? ofFleet(halt) : ofSingle();
  const resume = () => {
    if (goGuard.takes(performance.now())) onResume();
  };
  return (
    <Banner
      priority="held"
      word={t("held.word")}
      what={<b>{what}</b>}
      todo={more}
      actions={
        <Button onPress={resume} disabled={refused !== undefined}>
          {t("held.resume")}
        </Button>
      }
    />
  );

  function ofFleet(h: FleetHalt): [string, string] {
    const by = h.by === undefined ? t("commands:held.somebody") : words.actor(h.by);
    const who = t(h.at === undefined ? "held.fleet_plain" : "held.fleet", { by, time: dateTime(h.at, now) });
    const also = singly.length > 0 ? t("held.also", { names }) : t("held.goes_on");
    return [who, `${progress(h)} ${also}`];
  }
  function ofSingle(): [string, string] {
    if (singly.length === 1 && first !== undefined) return [first.name, held(first)];
    return [t("held.singly", { count: singly.length, names }), t("held.goes_on")];
  }
  function progress({ all, moving, unheard, total, held }: FleetHalt): string {
    if (moving > 0) return t("held.moving", { moving, total });
    if (!all) return t("held.some", { held, total });
    return unheard > 0 ? t("held.unheard", { unheard, total }) : t("held.stand", { total });
  }
}
