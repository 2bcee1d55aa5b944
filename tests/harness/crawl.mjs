// Reads all that a page says (shown, read aloud, painted on a canvas) and tells what of it was never meant for people.

/** Runs in the page before its own scripts: keeps what each canvas says as it is now. */
export function rememberPaint() {
  const texts = new WeakMap();
  const of = (canvas) => {
    if (!texts.has(canvas)) texts.set(canvas, []);
    return texts.get(canvas);
  };
  const pen = CanvasRenderingContext2D.prototype;
  for (const name of ["fillText", "strokeText"]) {
    const paint = pen[name];
    pen[name] = function (text, ...rest) {
      of(this.canvas).push(String(text));
      return paint.call(this, text, ...rest);
    };
  }
  // What covers the whole canvas takes its words away; a canvas brings its own along.
  const draw = pen.drawImage;
  pen.drawImage = function (source, ...rest) {
    if (source.width >= this.canvas.width && source.height >= this.canvas.height) texts.set(this.canvas, [...(texts.get(source) ?? [])]);
    return draw.call(this, source, ...rest);
  };
  for (const side of ["width", "height"]) {
    const size = Object.getOwnPropertyDescriptor(HTMLCanvasElement.prototype, side);
    Object.defineProperty(HTMLCanvasElement.prototype, side, {
      ...size,
      set(value) {
        texts.delete(this);
        size.set.call(this, value);
      },
    });
  }
  globalThis.paintedOn = (canvas) => [...new Set(of(canvas))];
}

/** Every text of the page with its language and where it stands. A part that declares another language is judged by that one. */
export async function wordsOf(page) {
  return page.evaluate(() => {
    const words = [];
    const languageOf = (e) => (e.closest("[lang]")?.lang.startsWith("zh") ? "zh" : "en");
    const say = (e, text, how) => {
      if (text.trim() === "") return;
      const place = `${e.tagName.toLowerCase()}${[...e.classList].map((name) => `.${name}`).join("")}`;
      words.push({ text: text.trim(), language: languageOf(e), where: how === "" ? place : `${place} ${how}` });
    };
    const shown = (e) => e.checkVisibility({ visibilityProperty: true });
    say(document.documentElement, document.title, "title");
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node; (node = walker.nextNode()); ) {
      const e = node.parentElement;
      if (!["SCRIPT", "STYLE"].includes(e.tagName) && shown(e.closest("select") ?? e)) say(e, node.data, "");
    }
    for (const e of document.querySelectorAll("body *")) {
      if (!shown(e)) continue;
      for (const name of ["aria-label", "aria-description", "aria-valuetext", "aria-roledescription", "title", "placeholder", "alt", "data-label"]) {
        if (e.hasAttribute(name)) say(e, e.getAttribute(name), name);
      }
      if (e.tagName === "CANVAS") for (const text of globalThis.paintedOn(e)) say(e, text, "painted");
    }
    return words;
  });
}

const kNeverShown = [
  ["a hole", /\{\{|\}\}/],
  ["no value", /\b(?:NaN|undefined|null|-?Infinity)\b|\[object |Invalid Date/],
  ["a code", /[A-Za-z0-9]+(?:_[A-Za-z0-9]+)+/],
  ["a program's name", /\b(?:[a-z]+[A-Z]|[A-Z][a-z]+[A-Z])[A-Za-z]*\b/],
  ["a key", /\b[a-z][a-z_]*(?:[.:][a-z][a-z_]*)+\b/],
];
const kForeign = {
  en: ["Chinese", /[\u2e80-\u9fff\uff00-\uffef]/],
  zh: ["English", /[A-Za-z]{2,}/],
};

const escaped = (text) => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");

/** Faults of texts in words, none is an empty list. `allowed`: names and units as strings or patterns, never found fault with. */
export function faultsOfWords(words, allowed = []) {
  const parts = allowed.map((one) => (one instanceof RegExp ? one.source : escaped(one))).sort((a, b) => b.length - a.length);
  const names = parts.length === 0 ? undefined : new RegExp(`(?<![A-Za-z0-9_])(?:${parts.join("|")})(?![A-Za-z0-9_])`, "g");
  const faults = new Set();
  for (const { text, language, where } of words) {
    const rest = names === undefined ? text : text.replace(names, "\u2026");
    for (const [what, pattern] of [...kNeverShown, kForeign[language]]) {
      if (pattern.test(rest)) faults.add(`${what} in ${language}: "${text}" (${where})`);
    }
  }
  return [...faults];
}
