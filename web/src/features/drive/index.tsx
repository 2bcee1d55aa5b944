import { useEffect } from "react";
import { navigate } from "@/shared/router";
import { DrivePage } from "./DrivePage";

/** The control of the vehicle in the address; without one there is nothing to drive. */
export default function Drive({ id }: { id?: string }) {
  useEffect(() => {
    if (id === undefined) navigate("/vehicles");
  }, [id]);
  return id === undefined ? null : <DrivePage key={id} id={id} />;
}
