import { useState, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import { useLinkLost, useNow, usePlant } from "@/shared/live";
import { setLanguage, setTheme } from "@/shared/i18n/setup";
import { useTheme } from "@/shared/i18n/useTheme";
import { Link, useLocation } from "@/shared/router";
import { timeOfDay } from "@/shared/words/format";
import { Button, Icon, type IconName } from "@/shared/ui";
import { AlarmCounts } from "./AlarmCounts";
import { Banners } from "./Banners";
import { Connection } from "./Connection";
import { PauseFleet } from "./PauseFleet";
import { ResumePanel } from "./ResumePanel";
import { UserMenu } from "./UserMenu";
import "./Shell.css";

const kScreens: readonly { name: string; icon: IconName }[] = [
  { name: "map", icon: "map" },
  { name: "send", icon: "send" },
  { name: "orders", icon: "orders" },
  { name: "stations", icon: "stations" },
  { name: "vehicles", icon: "veh" },
  { name: "loads", icon: "load" },
  { name: "records", icon: "rec" },
];

function Clock() {
  return (
    <div className="cell clock">
      <strong>{timeOfDay(useNow(500).wallMs)}</strong>
    </div>
  );
}

function LanguageChoice() {
  const { t, i18n } = useTranslation();
  const zh = i18n.language === "zh";
  return (
    <div className="cell lang">
      <div className="seg" role="group" aria-label={t("language")}>
        <button type="button" lang="en" aria-pressed={!zh} onClick={() => void setLanguage("en")}>
          EN
        </button>
        <button type="button" lang="zh-CN" aria-pressed={zh} onClick={() => void setLanguage("zh")}>
          中文
        </button>
      </div>
    </div>
  );
}

/** A symbol alone where the header has room for no more. */
function ThemeToggle({ inWords = false }: { inWords?: boolean }) {
  const { t } = useTranslation();
  const theme = useTheme();
  const does = theme === "dark" ? t("theme.to_light") : t("theme.to_dark");
  return (
    <div className="cell theme">
      <Button
        quiet
        icon="sun"
        {...(!inWords && { label: does })}
        onPress={() => setTheme(theme === "dark" ? "light" : "dark")}
      >
        {inWords ? does : undefined}
      </Button>
    </div>
  );
}

/** Frame of every screen: header with Pause fleet in the corner, rail, banner, page. */
export function Shell({ children }: { children: ReactNode }) {
  const { t } = useTranslation();
  const { path } = useLocation();
  const plant = usePlant().data;
  const [resumeOpen, setResumeOpen] = useState(false);
  const current = path.split("/")[1] || "map";
  return (
    <div className="app" data-link={useLinkLost() ? "lost" : undefined}>
      <a className="skip btn" href="#page">
        {t("skip")}
      </a>
      <header className="shell">
        <div className="brand">
          <svg
            viewBox="0 0 40 40"
            fill="none"
            stroke="var(--ink)"
            strokeWidth="3"
            role="img"
            aria-label={t("brand")}
          >
            <path d="M3 22H11L15 9L22 32L26.5 18L29 22H31" />
            <path d="M33 16.5L38 22L33 27.5" stroke="var(--accent)" />
          </svg>
        </div>
        <div className="plant">
          <div>
            <strong>{plant?.name ?? t("brand")}</strong>
            <span className="cap">{plant?.halls.map((hall) => hall.name).join(", ")}</span>
          </div>
        </div>
        <div className="grow" />
        <Connection />
        <AlarmCounts />
        <Clock />
        <ThemeToggle />
        <LanguageChoice />
        <UserMenu>
          <ThemeToggle inWords />
          <LanguageChoice />
        </UserMenu>
        <PauseFleet />
      </header>
      <nav className="rail" aria-label={t("nav.label")}>
        {kScreens.map(({ name, icon }) => (
          <Link
            key={name}
            to={`/${name}`}
            className={current === name ? "on" : ""}
            aria-current={current === name ? "page" : undefined}
          >
            <Icon name={icon} />
            <span>{t(`nav.${name}`)}</span>
          </Link>
        ))}
      </nav>
      <main className="page" id="page" tabIndex={-1}>
        <Banners onResume={() => setResumeOpen(true)} />
        {children}
      </main>
      {resumeOpen && <ResumePanel onClose={() => setResumeOpen(false)} />}
    </div>
  );
}
