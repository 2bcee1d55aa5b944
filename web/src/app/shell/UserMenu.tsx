import { useEffect, useRef, useState, type ReactNode } from "react";
import { useTranslation } from "react-i18next";
import { useSession } from "@/shared/live";
import { signOut } from "@/shared/live/session";
import { useLocation } from "@/shared/router";
import { Button } from "@/shared/ui";
import "./UserMenu.css";

const initials = (name: string) =>
  name
    .split(/[\s._-]+/)
    .filter(Boolean)
    .slice(0, 2)
    .map((part) => part[0]?.toUpperCase() ?? "")
    .join("");

/** Who is signed in, and the way out; `children` is what a small header has no room for. */
export function UserMenu({ children }: { children: ReactNode }) {
  const { t } = useTranslation();
  const session = useSession();
  const [open, setOpen] = useState(false);
  const box = useRef<HTMLDivElement>(null);
  const { path } = useLocation();
  useEffect(() => setOpen(false), [path]);
  useEffect(() => {
    if (!open) return;
    const outside = (event: Event) => {
      if (!(event.target instanceof Node) || !box.current?.contains(event.target)) setOpen(false);
    };
    document.addEventListener("pointerdown", outside);
    document.addEventListener("focusin", outside);
    return () => {
      document.removeEventListener("pointerdown", outside);
      document.removeEventListener("focusin", outside);
    };
  }, [open]);
  if (session === undefined) return null;
  return (
    <div className="cell who" ref={box} onKeyDown={(event) => event.key === "Escape" && setOpen(false)}>
      <button
        type="button"
        aria-expanded={open}
        aria-label={`${t("user.menu")}: ${session.name}, ${t(`role.${session.role}`)}`}
        onClick={() => setOpen((was) => !was)}
      >
        <span className="avatar">{initials(session.name)}</span>
        <span className="gt-sm">
          <strong>{session.name}</strong>
          <span className="cap">{t(`role.${session.role}`)}</span>
        </span>
      </button>
      {open && (
        <div className="note menu">
          {children}
          <Button quiet icon="out" onPress={() => void signOut()}>
            {t("user.sign_out")}
          </Button>
        </div>
      )}
    </div>
  );
}
