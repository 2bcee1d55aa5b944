import type { ReactNode } from "react";
import { Link } from "@/shared/router";
import { useWords } from "@/shared/words/useWords";
import "./LoadLink.css";

/** A load's name as the link to its page. */
export function LoadLink({ id, children }: { id: string; children?: ReactNode }) {
  const words = useWords();
  return (
    <Link
      className="inline loadlink"
      to={`/loads/${encodeURIComponent(id)}`}
      onClick={(event) => event.stopPropagation()}
    >
      {children ?? words.load(id)}
    </Link>
  );
}
