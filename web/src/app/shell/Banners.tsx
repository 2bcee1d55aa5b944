import { useEffect, useMemo, useState, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import type { Fleet } from "@/shared/api/types";
import { age, days, timeOfDay } from "@/shared/words/format";
import {
  alarms,
  inHand,
  silent,
  useFleet,
  useLink,
  useMayCommand,
  useServerNow,
  useVehicle,
  useVehicles,
  type Alarm,
} from "@/shared/live";
import { Link, navigate, useLocation } from "@/shared/router";
import { Banner, Button, goGuard } from "@/shared/ui";
import { usePhone } from "@/shared/ui/useNarrow";
import { useAlarmWords } from "@/shared/words/useAlarmWords";
import { PauseBanner } from "./PauseBanner";
import "./Banners.css";

/** So many vehicles that wait are named in the banner; the panel behind its button has all. */
const kNamed = 3;

/** A cut shorter than this is not worth a word: a page that just loaded, a reconnect. */
const kGraceMs = 300;

function useShownAfter(on: boolean, ms: number): boolean {
  const [shown, setShown] = useState(false);
  useEffect(() => {
    if (!on) {
      setShown(false);
      return;
    }
    const timer = setTimeout(() => setShown(true), ms);
    return () => clearTimeout(timer);
  }, [on, ms]);
  return on && shown;
}

/** The most urgent thing, and below it who waits for a person. Always at the top of the page. */
export function Banners({ onResume }: { onResume: () => void }) {
  const link = useLink();
  const vehicles = useVehicles();
  const all = useMemo(() => alarms(vehicles), [vehicles]);
  // Who waits for a person has a banner of its own, with the button that answers it.
  const shown = all.filter((alarm) => alarm.priority !== "low" && alarm.kind !== "person");
  const [urgent] = shown;
  const readOnly = useFleet()?.read_only;
  const lost = useShownAfter(link.state.kind === "lost", kGraceMs);
  return (
    <div className="banners">
      {lost ? (
        <LinkLost />
      ) : readOnly ? (
        <ReadOnly since={readOnly.since} cause={readOnly.cause} />
      ) : (
        urgent && <AlarmBanner alarm={urgent} more={shown.length - 1} />
      )}
      <PauseBanner onResume={onResume} />
      <WaitingBanner onResume={onResume} />
      <ClockBanner />
    </div>
  );
}

function LinkLost() {
  const { t } = useTranslation();
  const link = useLink();
  const now = useServerNow(500);
  const time = link.ageS === undefined ? timeOfDay(undefined) : timeOfDay(now - link.ageS * 1000);
  return (
    <Banner
      priority="critical"
      word={t("link.lost_word")}
      what={<b>{t("link.lost_banner", { age: age(link.ageS) })}</b>}
      todo={t("link.lost_todo", { time })}
    />
  );
}

type Fault = NonNullable<Fleet["read_only"]>;

/** The server cannot store: it answers questions only, and no vehicle gets more floor. */
function ReadOnly({ since, cause }: Fault) {
  const { t } = useTranslation();
  const now = useServerNow(500);
  return (
    <Banner
      priority="critical"
      word={t("read_only.word")}
      what={
        <>
          <b>{t("read_only.what")}</b> <span className="lab">{t(`read_only.cause.${cause}`)}</span>
        </>
      }
      todo={t("read_only.todo")}
      age={age((now - Date.parse(since)) / 1000)}
    />
  );
}

function AlarmBanner({ alarm, more }: { alarm: Alarm; more: number }) {
  const { t } = useTranslation();
  const words = useAlarmWords();
  const vehicle = useVehicle(alarm.vehicle);
  const phone = usePhone();
  const map = `/map?vehicle=${encodeURIComponent(alarm.vehicle)}`;
  const what = (
    <>
      <b>{vehicle?.name ?? alarm.vehicle}</b>
      {t("alarm.colon")}
      {words.text(alarm, vehicle)}
    </>
  );
  const show = <Button onPress={() => navigate(map)}>{t("alarm.show")}</Button>;
  if (phone) return <BriefAlarm priority={alarm.priority} what={what} map={map} more={more} show={show} />;
  return (
    <Banner
      priority={alarm.priority}
      what={
        <>
          {what}
          {more > 0 && <span className="lab"> {t("alarm.more", { count: more })}</span>}
        </>
      }
      todo={words.todo(alarm)}
      actions={show}
    />
  );
}

/** On a phone the sentence alone, and a press on it shows the vehicle with what to do; the others are a press away, too. */
function BriefAlarm({ priority, what, map, more, show }: BriefAlarmProps) {
  const { t } = useTranslation();
  return (
    <Banner
      priority={priority}
      brief
      what={<Link to={map}>{what}</Link>}
      actions={
        more > 0 ? (
          <Button onPress={() => navigate("/vehicles")}>{t("alarm.others", { count: more })}</Button>
        ) : (
          show
        )
      }
    />
  );
}
interface BriefAlarmProps {
  priority: Alarm["priority"];
  what: ReactNode;
  map: string;
  more: number;
  show: ReactNode;
}

/** Vehicles that a person must allow to move; hidden while the fleet is paused, where the corner says it. */
function WaitingBanner({ onResume }: { onResume: () => void }) {
  const { t } = useTranslation();
  const fleet = useFleet();
  const vehicles = useVehicles();
  const link = useLink();
  const may = useMayCommand();
  const { path } = useLocation();
  const waiting = vehicles.filter((v) => v.needs_resume && !v.paused && !silent(v) && !inHand(v));
  // Where it is driven by hand it is let go there.
  const alone = waiting.length === 1 && path === `/drive/${encodeURIComponent(waiting[0]!.id)}`;
  if (waiting.length === 0 || alone || fleet?.paused) return null;
  const first = waiting.slice(0, kNamed).map((v) => v.name);
  const more = waiting.length - first.length;
  const names = first.join(t("join")) + (more > 0 ? ` ${t("resume.more", { count: more })}` : "");
  return (
    <Banner
      priority="high"
      word={t("resume.word")}
      what={<b>{t("resume.waits", { count: waiting.length, names })}</b>}
      todo={t("resume.why")}
      actions={
        <Button onPress={() => goGuard.takes(performance.now()) && onResume()} disabled={!link.live || !may}>
          {t("resume.action")}
        </Button>
      }
    />
  );
}

/** The machine's clock was set or stands still: what the server shows as time is not what the wall shows. */
function ClockBanner() {
  const { t } = useTranslation();
  const clock = useFleet()?.clock;
  if (clock === undefined) return null;
  const by = days(Math.abs(clock.ahead_s));
  return (
    <Banner
      priority="low"
      word={t("clock.word")}
      what={<b>{t(clock.ahead_s > 0 ? "clock.ahead" : "clock.behind", { by })}</b>}
      todo={t("clock.todo")}
    />
  );
}
