import { useState } from "react";
import { useTranslation } from "react-i18next";
import type { Vehicle, VehicleType } from "@/shared/api/types";
import { usePlant } from "@/shared/live";
import { Card, Chip } from "@/shared/ui";
import { age, degrees, fixed, kNone, millimetres, secondsSince } from "@/shared/words/format";
import type { Camera } from "./shownCameras";
import { onPicture, outlineOf } from "./onPicture";
import { kSteps, usePicture, type PictureStep } from "./usePicture";
import "./CameraCard.css";

type CameraType = VehicleType["cameras"][number];

/** One camera: newest picture, the code found, how far it is off the camera's axis. Without a report it says so and stays. */
export function CameraCard({
  vehicle,
  name,
  camera,
  type,
  now,
  steps = false,
}: {
  vehicle: Vehicle;
  name: string;
  camera: Camera | undefined;
  type: CameraType | undefined;
  now: number;
  /** Offers the steps by which a code is found (Tang 2020, Fig. 9): where there is room to look at them. */
  steps?: boolean;
}) {
  const { t } = useTranslation("body");
  const [step, setStep] = useState<PictureStep>("result");
  const title = t(`camera.title.${name}`, { defaultValue: t("camera.other", { name }) });
  const old = secondsSince(camera?.image_at, now);
  return (
    <Card
      className="cam"
      title={title}
      summary={<Chip symbol={camera?.found ? "c-ok" : "c-no"}>{found()}</Chip>}
      right={age(old)}
    >
      {steps && (
        <div className="seg camsteps" role="group" aria-label={t("camera.steps")}>
          {kSteps.map((one) => (
            <button key={one} type="button" aria-pressed={one === step} onClick={() => setStep(one)}>
              {t(`camera.step.${one}`)}
            </button>
          ))}
        </div>
      )}
      <div className="camin">
        <Picture vehicle={vehicle.id} name={name} camera={camera} type={type} title={title} step={step} />
        <Readings camera={camera} />
      </div>
    </Card>
  );

  function found(): string {
    if (camera === undefined)
      return t(vehicle.activity === "moving" ? "camera.while_driving" : "camera.not_reported");
    return camera.found ? camera.payload : whyNot(camera.why_not, t);
  }
}

function whyNot(why: string, t: (key: string, options?: Record<string, unknown>) => string): string {
  return why === ""
    ? t("camera.not_found")
    : t(`camera.why_not.${why}`, { defaultValue: why.replaceAll("_", " ") });
}

/** The picture changes when the server says that there is a newer one: nothing polls. */
function Picture({
  vehicle,
  name,
  camera,
  type,
  title,
  step,
}: {
  vehicle: string;
  name: string;
  camera: Camera | undefined;
  type: CameraType | undefined;
  title: string;
  step: PictureStep;
}) {
  const { t } = useTranslation("body");
  const shown = usePicture(vehicle, name, camera?.image_at, step);
  return (
    <div className="camimg" style={{ aspectRatio: `${type?.width_px ?? 1280} / ${type?.height_px ?? 1024}` }}>
      {shown === undefined ? (
        <span className="lab">{t("camera.no_image")}</span>
      ) : (
        <>
          <img
            src={shown}
            alt={t(step === "result" ? "camera.image" : "camera.image_step", {
              name: title,
              step: t(`camera.step.${step}`),
            })}
          />
          {camera && step === "result" && <Overlay camera={camera} type={type} />}
        </>
      )}
    </div>
  );
}

/** Cross hair of the camera's axis, the code's outline and a vector to its middle: forward is up in the picture as mounted. */
function Overlay({ camera, type }: { camera: Camera; type: CameraType | undefined }) {
  const size_m = useCodeSize(camera.payload);
  if (!type) return null;
  const { width_px: w, height_px: h, cu_px: cu, cv_px: cv } = type;
  const seen = camera.found && camera.forward_m !== undefined && camera.left_m !== undefined;
  const { u, v } = onPicture(type, camera.forward_m ?? 0, camera.left_m ?? 0);
  const outline = outlineOf(type, camera, size_m)
    .map((corner) => `${corner.u} ${corner.v}`)
    .join("L");
  const line = w / 175;
  return (
    <svg viewBox={`0 0 ${w} ${h}`} aria-hidden="true">
      <path className="axis0" d={`M0 ${cv}H${w}M${cu} 0V${h}`} strokeWidth={1.2 * line} />
      <path
        className="axis1"
        d={`M0 ${cv}H${w}M${cu} 0V${h}`}
        strokeWidth={0.5 * line}
        strokeDasharray={`${5 * line} ${2 * line}`}
      />
      {seen && (
        <>
          <path d={`M${outline}Z`} className="edge" strokeWidth={2.4 * line} />
          <path d={`M${outline}Z`} className="mark" strokeWidth={1.2 * line} />
          <path d={`M${cu} ${cv}L${u} ${v}`} className="edge" strokeWidth={4.4 * line} />
          <circle cx={u} cy={v} r={4 * line} className="edgef" />
          <path d={`M${cu} ${cv}L${u} ${v}`} className="mark" strokeWidth={2.4 * line} />
          <circle cx={u} cy={v} r={2.6 * line} className="markf" />
        </>
      )}
    </svg>
  );
}

const kUsualSize_m = 0.06;
function useCodeSize(payload: string): number {
  const markers = usePlant().data?.markers;
  return markers?.find((marker) => marker.payload === payload)?.size_m ?? kUsualSize_m;
}

function Readings({ camera }: { camera: Camera | undefined }) {
  const { t } = useTranslation("body");
  const seen = camera?.found ? camera : undefined;
  const forward = seen?.forward_m;
  const left = seen?.left_m;
  return (
    <div className="cv">
      <Reading
        caption={t(forward !== undefined && forward < 0 ? "camera.code_back" : "camera.code_forward")}
        value={forward === undefined ? kNone : millimetres(Math.abs(forward), { decimals: 2 })}
        unit="mm"
      />
      <Reading
        caption={t(left !== undefined && left < 0 ? "camera.code_right" : "camera.code_left")}
        value={left === undefined ? kNone : millimetres(Math.abs(left), { decimals: 2 })}
        unit="mm"
      />
      <Reading
        caption={t("camera.code_angle")}
        value={seen ? `${degrees(seen.angle_rad, { decimals: 2, sign: true })}°` : kNone}
      />
      <Reading caption={t("camera.residual")} value={seen ? fixed(seen.rms_px, 2) : kNone} unit="px" small />
    </div>
  );
}

function Reading({
  caption,
  value,
  unit,
  small,
}: {
  caption: string;
  value: string;
  unit?: string;
  small?: boolean;
}) {
  return (
    <div>
      <span className="cap">{caption}</span>
      <div className={`val ${small ? "sm" : ""}`}>
        <b>{value}</b>
        {unit !== undefined && <u>{unit}</u>}
      </div>
    </div>
  );
}
