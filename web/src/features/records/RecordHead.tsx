import { Trans, useTranslation } from "react-i18next";
import type { StopRecord } from "@/shared/api/types";
import { LoadLink } from "@/shared/body/LoadLink";
import { useServerNow } from "@/shared/live";
import { Link } from "@/shared/router";
import { Icon, StatusSymbol } from "@/shared/ui";
import { dateTime } from "@/shared/words/format";
import { useWords } from "@/shared/words/useWords";
import "./RecordHead.css";

/** The verdict on a stop, whose it is, and where to go on from it. */
export function RecordHead({ stop }: { stop: StopRecord }) {
  const { t } = useTranslation("records");
  const words = useWords();
  const now = useServerNow(60_000);
  const said = {
    vehicle: words.vehicle(stop.vehicle),
    number: stop.number,
    time: dateTime(stop.at, now),
    load: words.load(stop.load ?? ""),
  };
  const how = t("how", { mode: words.mode(stop.mode), attempt: stop.attempt });
  const send = `/send?vehicle=${encodeURIComponent(stop.vehicle)}`;
  return (
    <div className="card rechead">
      <Verdict inside={stop.inside} />
      <div className="grow">
        <h1>{t(stop.inside ? "inside_title" : "outside_title")}</h1>
        <span className="lab">
          {stop.load_kg > 0 && stop.load ? (
            <Trans
              t={t}
              i18nKey="said_load"
              values={said}
              components={{ load: <LoadLink id={stop.load} /> }}
            />
          ) : (
            t("said", said)
          )}
          <span className="gt-sm">
            {t("join")}
            {how}
          </span>
        </span>
        <div className="lab lt-sm">{how}</div>
      </div>
      <Link className="btn motion" to={`${send}&station=${stop.number}`}>
        {t("again")}
      </Link>
      <Link className="btn primary motion" to={send}>
        <Icon name="send" />
        <span>{t("next")}</span>
      </Link>
    </div>
  );
}

function Verdict({ inside }: { inside: boolean }) {
  if (!inside) return <StatusSymbol name="a-2" size={56} className="okb" />;
  return (
    <svg className="okb" viewBox="0 0 48 48" aria-hidden="true">
      <circle cx="24" cy="24" r="22" fill="var(--solid)" />
      <path d="M13 25L21 33L36 16" fill="none" stroke="var(--on-solid)" strokeWidth="4.5" />
    </svg>
  );
}
