import { useTranslation } from "react-i18next";
import { useHeldWords, useRefusal } from "@/shared/commands";
import { dateTime } from "@/shared/words/format";
import { fleetHalt, pausedSingly, useFleet, useServerNow, useVehicles } from "@/shared/live";
import { Banner, Button, goGuard } from "@/shared/ui";

/** On every page: who has the fleet or single vehicles stand, since when, and who of them still moves. */
export function PauseBanner({ onResume }: { onResume: () => void }) {
  const { t } = useTranslation(["common", "commands"]);
  const held = useHeldWords();
  const refused = useRefusal();
  const now = useServerNow(60_000);
  const vehicles = useVehicles();
  const halt = fleetHalt(useFleet(), vehicles);
  const singly = pausedSingly(vehicles);
  const [only] = singly;
  if (halt === undefined && only === undefined) return null;
  const names = singly.map((v) => v.name).join(t("common:join"));
  const lines = (): [string, string] => {
    if (halt === undefined)
      return singly.length === 1 && only !== undefined
        ? [only.name, held(only)]
        : [t("held.singly", { count: singly.length, names }), t("held.goes_on")];
    const by = halt.by ?? t("commands:held.somebody");
    const key = halt.at === undefined ? "held.fleet_plain" : "held.fleet";
    const also = singly.length > 0 && halt.all ? t("held.also", { names }) : t("held.goes_on");
    return [t(key, { by, time: dateTime(halt.at, now) }), `${progress(halt)} ${also}`];
  };
  const progress = (h: NonNullable<typeof halt>) => {
    const values = { moving: h.moving, unheard: h.unheard, total: h.total, held: h.held };
    if (h.moving > 0) return t("held.moving", values);
    if (!h.all) return t("held.some", values);
    return t(h.unheard > 0 ? "held.unheard" : "held.stand", values);
  };
  const [what, more] = lines();
  return (
    <Banner
      priority="held"
      word={t("held.word")}
      what={<b>{what}</b>}
      todo={more}
      actions={
        <Button
          onPress={() => goGuard.takes(performance.now()) && onResume()}
          disabled={refused !== undefined}
        >
          {t("held.resume")}
        </Button>
      }
    />
  );
}
