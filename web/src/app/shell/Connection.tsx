import { useTranslation } from "react-i18next";
import { age } from "@/shared/words/format";
import { useFleet, useLink } from "@/shared/live";
import { Icon, StatusSymbol } from "@/shared/ui";
import "./Connection.css";

/** Link to the server with the age of its newest data, and how many vehicles are heard. */
export function Connection() {
  const { t } = useTranslation();
  const link = useLink();
  const fleet = useFleet();
  const word = { live: t("link.live"), lost: t("link.lost"), connecting: t("link.connecting") }[
    link.state.kind
  ];
  return (
    <div className={`cell conn ${link.state.kind}`} data-link={link.state.kind}>
      {link.state.kind === "lost" ? <StatusSymbol name="s-stale" size={24} /> : <Icon name="link" />}
      <div>
        <strong>
          {word} {link.ageS === undefined ? "" : age(link.ageS)}
        </strong>
        <span className={`cap ${link.state.kind === "lost" ? "old" : ""}`}>
          {fleet && t("link.vehicles", { live: fleet.vehicles_live, total: fleet.vehicles_total })}
        </span>
      </div>
    </div>
  );
}
