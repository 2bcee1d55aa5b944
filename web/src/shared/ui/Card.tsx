import type { ReactNode } from "react";
import "./Card.css";

export interface CardProps {
  title?: string;
  /** Plain words beside the title. */
  summary?: ReactNode;
  /** Right end of the header: age, link, button. */
  right?: ReactNode;
  children?: ReactNode;
  className?: string;
  /** Without the padding of `.in`, for tables and lists. */
  flush?: boolean;
  /** Its content may be longer than it: the keyboard reaches it, too. */
  scrolls?: boolean;
  /** Title as h1 for the first card of a page. */
  level?: 1 | 2 | 3;
}

export function Card({ title, summary, right, children, className, flush, scrolls, level = 2 }: CardProps) {
  const Title = `h${level}` as "h1" | "h2" | "h3";
  return (
    <section className={`card ${className ?? ""}`} aria-label={title}>
      {title !== undefined && (
        <header>
          <Title className="card-title">{title}</Title>
          {summary !== undefined && <span className="lab">{summary}</span>}
          <span className="grow" />
          {right !== undefined && <span className="cap nw">{right}</span>}
        </header>
      )}
      {flush ? (
        children
      ) : (
        <div className="in" {...(scrolls && { tabIndex: 0, role: "group", "aria-label": title })}>
          {children}
        </div>
      )}
    </section>
  );
}
