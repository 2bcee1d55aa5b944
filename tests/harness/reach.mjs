// What a finger can not reach on the page shown: too wide, too small, cut off or covered; and words that lie over each other. Runs in the page.

/** Faults of the layout in words; none is an empty list. Scrolls the page's own lists, and back to their beginning. `within`: a panel that lies over the rest. */
export async function reachFaultsOf(page, { least = 44, pause: hasPause = true, within = "body" } = {}) {
  return page.evaluate(([smallest, withPause, panel]) => {
    const faults = [];
    const kCommands = "button, a[href], input, select, summary, canvas[tabindex], [role=option], [role=radio], [role=tab]";
    const nameOf = (e) => `${e.tagName.toLowerCase()}.${[...e.classList].join(".")} "${(e.getAttribute("aria-label") ?? e.textContent ?? "").trim().slice(0, 30)}"`;
    const widestIn = (e) => [...e.querySelectorAll("*")].reduce((a, b) => (b.getBoundingClientRect().right > a.getBoundingClientRect().right ? b : a), e.firstElementChild ?? e);
    const wide = document.documentElement.scrollWidth - innerWidth;
    if (wide > 0) faults.push(`the page is ${wide} px too wide`);
    for (const e of document.querySelectorAll("body *")) {
      const over = e.scrollWidth - e.clientWidth;
      if (over > 1 && e.clientWidth > 0 && ["auto", "scroll"].includes(getComputedStyle(e).overflowX)) faults.push(`${nameOf(e)} scrolls sideways by ${over} px, to ${nameOf(widestIn(e))}`);
    }
    const pause = withPause ? document.querySelector("button.pause") : undefined;
    if (pause === null) faults.push("there is no Pause fleet");
    else if (pause !== undefined) {
      const r = pause.getBoundingClientRect();
      if (r.left < 0 || r.bottom > innerHeight + 0.5 || Math.abs(r.top) > 0.5 || Math.abs(r.right - innerWidth) > 0.5) faults.push("Pause fleet is not in its corner");
      for (const x of [r.left + 4, (r.left + r.right) / 2, r.right - 4]) {
        if (!pause.contains(document.elementFromPoint(x, (r.top + r.bottom) / 2))) faults.push("Pause fleet is covered");
      }
    }
    for (const e of document.querySelector(panel).querySelectorAll(kCommands)) {
      if (e.closest(".skip, .sr-only, .unseen") !== null || !e.checkVisibility({ visibilityProperty: true })) continue;
      const target = e.tagName === "INPUT" ? (e.closest("label") ?? e) : e;
      target.scrollIntoView({ block: "center", inline: "nearest", behavior: "instant" });
      const r = target.getBoundingClientRect();
      if (r.width < smallest - 0.5 || r.height < smallest - 0.5) faults.push(`${nameOf(e)} is only ${Math.round(r.width)} x ${Math.round(r.height)} px`);
      if (r.left < -0.5 || r.right > innerWidth + 0.5) faults.push(`${nameOf(e)} is cut at the side`);
      else if (target.tagName !== "CANVAS" && (r.top < -0.5 || r.bottom > innerHeight + 0.5)) faults.push(`${nameOf(e)} cannot be scrolled into sight`);
      else {
        const x = (r.left + r.right) / 2;
        const ys = r.height > 60 && target.tagName !== "CANVAS" ? [r.top + 6, (r.top + r.bottom) / 2, r.bottom - 6] : [(r.top + r.bottom) / 2];
        for (const y of ys) {
          const hit = document.elementFromPoint(x, y);
          if (hit === null || !(target.contains(hit) || hit.contains(target))) faults.push(`${nameOf(e)} is covered by ${hit === null ? "nothing" : nameOf(hit)}`);
          // A box between that cuts what it holds.
          else if (hit !== target && hit.contains(target)) faults.push(`${nameOf(e)} is cut off inside ${nameOf(hit)}`);
        }
      }
      if (e.matches("button, .btn") && (e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1)) faults.push(`the words of ${nameOf(e)} do not fit`);
    }
    for (const e of document.querySelectorAll("*")) if (e.scrollTop > 0) e.scrollTop = 0;
    return [...new Set(faults)];
  }, [least, hasPause, within]);
}

/** Words of one layer that lie over each other; none is an empty list. A panel or a bar that floats is a layer of its own. */
export async function overlapsOf(page) {
  return page.evaluate(() => {
    const floats = ({ position, zIndex }) => position === "fixed" || position === "sticky" || (position === "absolute" && zIndex !== "auto");
    /** Its layer, and the box that its ancestors let be seen of it. */
    const frameOf = (element) => {
      const seen = { left: 0, right: innerWidth, top: -Infinity, bottom: Infinity };
      let layer;
      for (let e = element; e !== null && layer === undefined; e = e.parentElement) {
        const style = getComputedStyle(e);
        if (style.overflow !== "visible") {
          const r = e.getBoundingClientRect();
          Object.assign(seen, { left: Math.max(seen.left, r.left), right: Math.min(seen.right, r.right), top: Math.max(seen.top, r.top), bottom: Math.min(seen.bottom, r.bottom) });
        }
        if (floats(style)) layer = e;
      }
      return { layer: layer ?? document.body, seen };
    };
    const lines = [];
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
      const node = texts.currentNode, element = node.parentElement;
      if (node.data.trim() === "" || element.closest(".sr-only, .unseen, .skip, script, style") !== null || !element.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue;
      const { layer, seen } = frameOf(element);
      const range = document.createRange();
      range.selectNodeContents(node);
      for (const r of range.getClientRects()) {
        // A font's box is higher than its letters.
        const box = { left: Math.max(r.left + 2, seen.left), right: Math.min(r.right - 2, seen.right), top: Math.max(r.top + r.height / 4, seen.top), bottom: Math.min(r.bottom - r.height / 4, seen.bottom) };
        if (box.right > box.left && box.bottom > box.top) lines.push({ node, layer, box, words: node.data.trim().slice(0, 40) });
      }
    }
    const faults = [];
    for (const [i, a] of lines.entries()) {
      for (const b of lines.slice(i + 1)) {
        if (a.node === b.node || a.layer !== b.layer) continue;
        if (Math.min(a.box.right, b.box.right) > Math.max(a.box.left, b.box.left) && Math.min(a.box.bottom, b.box.bottom) > Math.max(a.box.top, b.box.top)) faults.push(`"${a.words}" lies over "${b.words}"`);
      }
    }
    return [...new Set(faults)];
  });
}
