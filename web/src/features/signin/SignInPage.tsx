import { useRef, useState, type FormEvent } from "react";
import { useTranslation } from "react-i18next";
import { ApiProblem } from "@/shared/api";
import { problemText } from "@/shared/words/reasons";
import { setLanguage } from "@/shared/i18n/setup";
import { timeOfDay } from "@/shared/words/format";
import { signIn, useSessionState } from "@/shared/live/session";
import { Button, StatusSymbol } from "@/shared/ui";
import "./signin.css";

/** Name and password. An error is said in words, beside the form, and the password stays to be corrected. */
export function SignInPage() {
  const { t, i18n } = useTranslation("signin");
  const session = useSessionState();
  const ended = session.kind === "signed_out" ? session.ended : undefined;
  const [name, setName] = useState(ended?.name ?? "");
  const [password, setPassword] = useState("");
  const [busy, setBusy] = useState(false);
  const [error, setError] = useState<string>();
  const nameField = useRef<HTMLInputElement>(null);
  const passwordField = useRef<HTMLInputElement>(null);

  const submit = async (event: FormEvent) => {
    event.preventDefault();
    if (busy) return;
    if (name.trim() === "") {
      setError(t("empty_name"));
      nameField.current?.focus();
      return;
    }
    if (password === "") {
      setError(t("empty_password"));
      passwordField.current?.focus();
      return;
    }
    setBusy(true);
    setError(undefined);
    try {
      await signIn(name.trim(), password);
    } catch (problem) {
      const known =
        problem instanceof ApiProblem ? problem : new ApiProblem({ status: 0, code: "unexpected_answer" });
      setError(problemText(known, (key, values) => t(key, values ?? {})));
      setBusy(false);
      passwordField.current?.select();
    }
  };

  const zh = i18n.language === "zh";
  return (
    <main className="signin">
      <form className="card" onSubmit={(event) => void submit(event)} noValidate aria-label={t("title")}>
        <div className="top">
          <svg
            viewBox="0 0 40 40"
            width="48"
            height="48"
            fill="none"
            stroke="var(--ink)"
            strokeWidth="3"
            aria-hidden="true"
          >
            <path d="M3 22H11L15 9L22 32L26.5 18L29 22H31" />
            <path d="M33 16.5L38 22L33 27.5" stroke="var(--accent)" />
          </svg>
          <span className="grow">
            <b>Pulseline</b>
            <span className="cap">{t("note")}</span>
          </span>
          <div className="seg" role="group" aria-label={t("common:language")}>
            <button type="button" lang="en" aria-pressed={!zh} onClick={() => void setLanguage("en")}>
              EN
            </button>
            <button type="button" lang="zh-CN" aria-pressed={zh} onClick={() => void setLanguage("zh")}>
              中文
            </button>
          </div>
        </div>
        <h1>{t("title")}</h1>
        {ended && (
          <div className="ended" role="status">
            <b>{t("ended", { name: ended.name, time: timeOfDay(ended.atMs) })}</b>
            <span>{t("ended_why")}</span>
            <span>{t("ended_back")}</span>
          </div>
        )}
        <label>
          <span>{t("name")}</span>
          <input
            ref={nameField}
            name="username"
            autoComplete="username"
            autoCapitalize="none"
            maxLength={64}
            value={name}
            onChange={(event) => setName(event.target.value)}
          />
        </label>
        <label>
          <span>{t("password")}</span>
          <input
            ref={passwordField}
            name="password"
            type="password"
            autoComplete="current-password"
            maxLength={128}
            value={password}
            onChange={(event) => setPassword(event.target.value)}
          />
        </label>
        <div className="error" role="alert">
          {error !== undefined && (
            <>
              <StatusSymbol name="a-2" /> <span>{error}</span>
            </>
          )}
        </div>
        <Button type="submit" primary motion disabled={busy}>
          {busy ? t("busy") : t("submit")}
        </Button>
        <p className="cap">{t("hint")}</p>
      </form>
    </main>
  );
}
