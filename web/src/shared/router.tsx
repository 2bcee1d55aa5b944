import { useSyncExternalStore, type AnchorHTMLAttributes, type MouseEvent } from "react";

// History router, as small as eight screens need. Addresses: /map, /send?vehicle=TP-01, /vehicles/TP-01 ...
const listeners = new Set<() => void>();
const notify = () => listeners.forEach((listener) => listener());
window.addEventListener("popstate", notify);

export interface Location {
  path: string;
  query: URLSearchParams;
}

let cachedHref = "";
let cached: Location = { path: "/", query: new URLSearchParams() };
function location(): Location {
  if (cachedHref !== window.location.href) {
    cachedHref = window.location.href;
    cached = { path: window.location.pathname, query: new URLSearchParams(window.location.search) };
  }
  return cached;
}

export function useLocation(): Location {
  return useSyncExternalStore((listener) => {
    listeners.add(listener);
    return () => void listeners.delete(listener);
  }, location);
}

export function navigate(to: string, options: { replace?: boolean } = {}): void {
  if (options.replace) window.history.replaceState(null, "", to);
  else window.history.pushState(null, "", to);
  notify();
}

export type LinkProps = AnchorHTMLAttributes<HTMLAnchorElement> & { to: string };

/** A real link: opens in a new tab with the modifier keys, else without loading the page again. */
export function Link({ to, onClick, ...rest }: LinkProps) {
  const follow = (event: MouseEvent<HTMLAnchorElement>) => {
    onClick?.(event);
    if (event.defaultPrevented || event.button !== 0) return;
    if (event.metaKey || event.ctrlKey || event.shiftKey || event.altKey) return;
    event.preventDefault();
    navigate(to);
  };
  return <a href={to} onClick={follow} {...rest} />;
}
