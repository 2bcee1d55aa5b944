import { useTranslation } from "react-i18next";
import type { Vehicle, VehicleType } from "@/shared/api/types";
import { Card, Chip } from "@/shared/ui";
import { age, fixed, kNone, millimetres, secondsSince } from "@/shared/words/format";
import type { Camera } from "./shownCameras";
import { usePicture } from "./usePicture";
import "./CameraCard.css";

type CameraType = VehicleType["cameras"][number];

/** One camera: newest picture, the code found, how far it is off the camera's axis. Without a report it says so and stays. */
export function CameraCard({
  vehicle,
  name,
  camera,
  type,
  now,
}: {
  vehicle: Vehicle;
  name: string;
  camera: Camera | undefined;
  type: CameraType | undefined;
  now: number;
}) {
  const { t } = useTranslation("vehicles");
  const title = t(`camera.title.${name}`, { defaultValue: t("camera.other", { name }) });
  const old = secondsSince(camera?.image_at, now);
  return (
    <Card
      className="cam"
      title={title}
      summary={<Chip symbol={camera?.found ? "c-ok" : "c-no"}>{found()}</Chip>}
      right={age(old)}
    >
      <div className="camin">
        <Picture vehicle={vehicle.id} name={name} camera={camera} type={type} title={title} />
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
}: {
  vehicle: string;
  name: string;
  camera: Camera | undefined;
  type: CameraType | undefined;
  title: string;
}) {
  const { t } = useTranslation("vehicles");
  const shown = usePicture(vehicle, name, camera?.image_at);
  return (
    <div className="camimg" style={{ aspectRatio: `${type?.width_px ?? 1280} / ${type?.height_px ?? 1024}` }}>
      {shown === undefined ? (
        <span className="lab">{t("camera.no_image")}</span>
      ) : (
        <>
          <img src={shown} alt={t("camera.image", { name: title })} />
          {camera && <Overlay camera={camera} type={type} />}
        </>
      )}
    </div>
  );
}

/** Cross hair of the camera's axis and a vector to the code: forward is up in the picture as mounted. */
function Overlay({ camera, type }: { camera: Camera; type: CameraType | undefined }) {
  if (!type) return null;
  const scale = type.f_px / type.height_m; // px per metre on the floor
  const { width_px: w, height_px: h, cu_px: cu, cv_px: cv } = type;
  const seen = camera.found && camera.forward_m !== undefined && camera.left_m !== undefined;
  const mount = type.body_from_camera.heading_rad;
  // Body offsets into the camera's own axes: image u is camera x, image v camera y, seen from above.
  const fx = camera.forward_m ?? 0;
  const fy = camera.left_m ?? 0;
  const x = Math.cos(mount) * fx + Math.sin(mount) * fy;
  const y = -Math.sin(mount) * fx + Math.cos(mount) * fy;
  const u = cu + x * scale;
  const v = cv - y * scale;
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
          <path d={`M${cu} ${cv}L${u} ${v}`} className="edge" strokeWidth={4.4 * line} />
          <circle cx={u} cy={v} r={4 * line} className="edgef" />
          <path d={`M${cu} ${cv}L${u} ${v}`} className="mark" strokeWidth={2.4 * line} />
          <circle cx={u} cy={v} r={2.6 * line} className="markf" />
        </>
      )}
    </svg>
  );
}

function Readings({ camera }: { camera: Camera | undefined }) {
  const { t } = useTranslation("vehicles");
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
  unit: string;
  small?: boolean;
}) {
  return (
    <div>
      <span className="cap">{caption}</span>
      <div className={`val ${small ? "sm" : ""}`}>
        <b>{value}</b>
        <u>{unit}</u>
      </div>
    </div>
  );
}
