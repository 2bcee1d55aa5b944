import en from "@/shared/words/catalogs/words.en.json";
import zh from "@/shared/words/catalogs/words.zh.json";

const kKeys = new Map(
  [en.closure, zh.closure].flatMap((names) => Object.entries(names).map(([key, name]) => [name, key])),
);

/** Key of why floor is closed, when it is one that the page offers: it is stored in the language of who closed it. */
export const closureKey = (name: string): string | undefined => kKeys.get(name);

/** The name in the language shown; one that somebody has made up stays as it is. */
export function closureName(name: string, t: (key: string) => string): string {
  const key = closureKey(name);
  return key === undefined ? name : t(`words:closure.${key}`);
}
