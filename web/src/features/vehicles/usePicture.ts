import { useEffect, useState } from "react";
import { api, call } from "@/shared/api";

/**
 * Address of the newest picture of a camera, asked for again when `at` changes. The old one stays until
 * the new one is there; a picture that does not come leaves the old one.
 */
export function usePicture(vehicle: string, camera: string, at: string | undefined): string | undefined {
  const [shown, setShown] = useState<string>();
  useEffect(() => {
    if (at === undefined) return;
    let current = true;
    call(
      api.GET("/api/v1/vehicles/{id}/cameras/{camera}", {
        params: { path: { id: vehicle, camera } },
        parseAs: "blob",
        cache: "no-cache",
      }),
    ).then(
      (picture) => current && setShown(URL.createObjectURL(picture as Blob)),
      () => undefined, // no picture yet, or the link is gone: the banner says so
    );
    return () => {
      current = false;
    };
  }, [vehicle, camera, at]);
  useEffect(() => (shown === undefined ? undefined : () => URL.revokeObjectURL(shown)), [shown]);
  return shown;
}
