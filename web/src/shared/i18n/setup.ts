import i18next, { type Resource } from "i18next";
import { initReactI18next } from "react-i18next";

export type Language = "en" | "zh";
export type Theme = "light" | "dark";

const kLanguageKey = "pulseline.language";
const kThemeKey = "pulseline.theme";

// Namespaces: shared/words/catalogs/<namespace>.<language>.json and features/<feature>/i18n.<language>.json.
const shared = import.meta.glob<Record<string, unknown>>("../words/catalogs/*.{en,zh}.json", {
  eager: true,
  import: "default",
});
const features = import.meta.glob<Record<string, unknown>>("../../features/*/i18n.{en,zh}.json", {
  eager: true,
  import: "default",
});

export function catalogs(): Resource {
  const resources: Resource = { en: {}, zh: {} };
  for (const [path, catalog] of [...Object.entries(shared), ...Object.entries(features)]) {
    const match = /(?:\/([^/]+)\/i18n|\/([^/]+))\.(en|zh)\.json$/.exec(path);
    const namespace = match?.[1] ?? match?.[2];
    const language = match?.[3];
    if (namespace === undefined || language === undefined) continue;
    resources[language]![namespace] = catalog as Resource[string][string];
  }
  return resources;
}

function remembered(key: string): string | null {
  try {
    return localStorage.getItem(key);
  } catch {
    return null; // storage may be forbidden
  }
}

function remember(key: string, value: string): void {
  try {
    localStorage.setItem(key, value);
  } catch {
    // Then the choice lasts as long as the page.
  }
}

/** The address wins (?lang=zh&theme=dark), then what was chosen here, then the browser. */
export function startLanguage(search: string): Language {
  const wanted = new URLSearchParams(search).get("lang") ?? remembered(kLanguageKey) ?? navigator.language;
  return wanted.toLowerCase().startsWith("zh") ? "zh" : "en";
}

export function startTheme(search: string): Theme {
  const wanted = new URLSearchParams(search).get("theme") ?? remembered(kThemeKey);
  if (wanted === "dark" || wanted === "light") return wanted;
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

const themeListeners = new Set<() => void>();
let theme: Theme = "light";

export const currentTheme = (): Theme => theme;
export function subscribeTheme(listener: () => void): () => void {
  themeListeners.add(listener);
  return () => void themeListeners.delete(listener);
}

export function setTheme(next: Theme, keep = true): void {
  theme = next;
  document.documentElement.dataset.theme = next;
  if (keep) remember(kThemeKey, next);
  for (const listener of themeListeners) listener();
}

export async function setLanguage(next: Language, keep = true): Promise<void> {
  await i18next.changeLanguage(next);
  document.documentElement.lang = next === "zh" ? "zh-CN" : "en";
  if (keep) remember(kLanguageKey, next);
}

export async function startI18n(search: string): Promise<void> {
  const language = startLanguage(search);
  await i18next.use(initReactI18next).init({
    resources: catalogs(),
    lng: language,
    fallbackLng: "en",
    supportedLngs: ["en", "zh"],
    defaultNS: "common",
    fallbackNS: "common",
    interpolation: { escapeValue: false, skipOnVariables: true },
    returnNull: false,
  });
  const query = new URLSearchParams(search);
  setTheme(startTheme(search), query.has("theme"));
  await setLanguage(language, query.has("lang"));
}
