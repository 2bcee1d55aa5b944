import { useEffect, useState } from "react";
import { api, call } from "@/shared/api";

/** The picture with what was read, and what the steps of Tang 2020 (Fig. 9) make of it. */
export const kSteps = ["result", "grey", "edges", "corners"] as const;
export type PictureStep = (typeof kSteps)[number];

/**
 * Address of the newest picture of a camera, asked for again when `at` changes. The old one stays until
 * the new one is there; a picture that does not come leaves the old one.
 */
export function usePicture(
  vehicle: string,
  camera: string,
  at: string | undefined,
  step: PictureStep,
): string | undefined {
  const [shown, setShown] = useState<string>();
  useEffect(() => {
    if (at === undefined) return;
    let current = true;
    const how = { parseAs: "blob", cache: "no-cache" } as const;
    const path = { id: vehicle, camera };
    call<unknown>(
      step === "result"
        ? api.GET("/api/v1/vehicles/{id}/cameras/{camera}", { params: { path }, ...how })
        : api.GET("/api/v1/vehicles/{id}/cameras/{camera}/steps/{step}", {
            params: { path: { ...path, step } },
            ...how,
          }),
    ).then(
      (picture) => current && setShown(URL.createObjectURL(picture as Blob)),
      () => undefined, // no picture yet, or the link is gone: the banner says so
    );
    return () => {
      current = false;
    };
  }, [vehicle, camera, at, step]);
  useEffect(() => (shown === undefined ? undefined : () => URL.revokeObjectURL(shown)), [shown]);
  return shown;
}
