/** The line of a hand-held control of one vehicle: frames as HandHeldCommand and HandHeldAnswer say. */
export function openHandHeld(vehicle: string): WebSocket {
  const origin = window.location.origin.replace(/^http/, "ws");
  return new WebSocket(`${origin}/api/v1/vehicles/${encodeURIComponent(vehicle)}/hand-held`);
}
