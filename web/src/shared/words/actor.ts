import type { Translate } from "./sentence";

const kToken = "token:";

/** Who did something, as people say it: a person by name; a program by the beginning of its token's id. */
export function actorText(actor: string, t: Translate): string {
  return actor.startsWith(kToken)
    ? t("words:program", { id: actor.slice(kToken.length).slice(0, 6) })
    : actor;
}
