#!/usr/bin/env python3
"""Drafts the demo plants of db/plants. Not part of the build: the JSON files are the source of truth,
this only saves typing when a plant is laid out anew.   Usage: make_plants.py [FOLDER]"""
import json
import math
import pathlib
import sys

PI = math.pi
DEG = PI / 180


def point(x, y):
    return {"x_m": round(x, 6), "y_m": round(y, 6)}


def pose(x, y, heading):
    h = heading - 2 * PI * round(heading / (2 * PI))
    return {**point(x, y), "heading_rad": h}


def ring(points):
    return [point(*p) for p in points]


def box(x0, y0, x1, y1):
    return ring([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def rect(length, width):
    return box(-length / 2, -width / 2, length / 2, width / 2)


def along(p, forward, left=0.0):
    """Point in front of and to the left of a pose (x, y, heading)."""
    x, y, h = p
    return (x + forward * math.cos(h) - left * math.sin(h), y + forward * math.sin(h) + left * math.cos(h))


# Half outline of the fighter of the map's mock, nose to tail.
HALF = [(5.6, 0.58), (3.6, 0.86), (1, 1.85), (-2, 4.9), (-2.35, 5), (-3.25, 5), (-3.75, 1.5), (-5.3, 1.25),
        (-6.8, 3.05), (-7.65, 3.1), (-8, 0.62)]
FIGHTER = ring([(8, 0)] + HALF + [(x, -y) for x, y in reversed(HALF)])


def camera(name, x, y=0.0):
    return {"name": name, "body_from_camera": pose(x, y, 0), "height_m": 0.455, "f_px": 3317.78,
            "width_px": 1280, "height_px": 1024, "cu_px": 639.5, "cv_px": 511.5, "k1": 0}


def scanners(footprint):
    """Two at opposite corners, each looking away from the body."""
    xs, ys = [p["x_m"] for p in footprint], [p["y_m"] for p in footprint]
    return [{"name": "front left", "pose": pose(max(xs), max(ys), PI / 4)},
            {"name": "back right", "pose": pose(min(xs), min(ys), -3 * PI / 4)}]


def far_sighted(kind):
    """For halls whose walls are out of an UST-10LX's sight: with the figures of an UST-30LX, at its farthest."""
    return {**kind, "scanners": [{**one, "range_m": 30, "sigma_m": 0.02, "most_error_m": 0.05} for one in kind["scanners"]]}


def wheel(name, x, y, driven, steered, diameter):
    return {"name": name, "position": point(x, y), "driven": driven, "steered": steered, "diameter_m": diameter}


CAMERA_X = 5.346
PLATFORM = {  # Tang 2020, Tables 1 to 3; y to the left
    "id": "transport-platform", "name": "Transport platform", "kinematics": "steered_platform",
    "footprint": rect(10.5, 2.5), "load_footprint": FIGHTER,
    "max_speed_mps": 1.67, "max_accel_mps2": 0.2, "max_turn_rate_radps": 0.12, "max_turn_accel_radps2": 0.04,
    "min_turn_radius_m": 5, "max_arc_radius_m": 200, "clearance_m": 0.5, "height_m": 1.3,
    "usual_code": {"kind": "qr", "size_m": 0.06}, "slip_sensor": {"noise_mps": 0.002},
    "motion_modes": ["auto", "self_rotation", "linear", "fixed_axis_rotation", "free"],
    "wheels": [wheel("FL", 4.97, 0.925, False, True, 0.3), wheel("FR", 4.97, -0.925, False, True, 0.3),
               wheel("BL", -4.97, 0.925, False, True, 0.3), wheel("BR", -4.97, -0.925, False, True, 0.3),
               wheel("front drive", 4.815, 0, True, True, 0.41), wheel("back drive", -4.815, 0, True, True, 0.41)],
    # Four of them below the middle of the body (section 2.1); no table has their places and sizes.
    "casters": [{"name": n, "position": point(x, y), "diameter_m": 0.2} for n, x, y in
                [("front left", 1.6, 0.9), ("front right", 1.6, -0.9), ("back left", -1.6, 0.9), ("back right", -1.6, -0.9)]],
    "control": {"cycle_s": 0.01, "drive_gain_per_s": 3.5, "steering_gain_per_s": 8, "lift_gain_per_s": 10},
    "drive_temperatures": {"warm_c": 65, "hot_c": 90},
    "cameras": [camera("front", CAMERA_X), camera("back", -CAMERA_X)], "scanners": scanners(rect(10.5, 2.5)),
    "brackets": [{"name": n, "position": point(x, y)} for n, x, y in
                 [("front left", 2.4, 0.7), ("front right", 2.4, -0.7), ("back left", -3.0, 0.7),
                  ("back right", -3.0, -0.7)]],
    "parking": {"feet": [{"name": n, "position": point(x, y)} for n, x, y in
                         [("front left", 5.25, 1.25), ("front right", 5.25, -1.25), ("back left", -5.25, 1.25),
                          ("back right", -5.25, -1.25)]],
                "stroke_m": 0.15, "clearance_m": 0.1, "lift_m": 0.02, "speed_mps": 0.02, "rating_n": 120000},
    "mass_kg": 10200, "max_load_kg": 22000,
    # Between the brackets; across, their balance asks for less still.
    "load_rules": {"bracket_rating_n": 80000, "most_unbalance": 0.1, "centre": [point(-2.4, -0.15), point(1.8, -0.15), point(1.8, 0.15), point(-2.4, 0.15)]},
    "bracket_lift": {"stroke_m": 0.3, "speed_mps": 0.01}}


def mecanum(kind, name, length, width, height, camera_x, speed, mass, load, receivers=(), scanner=None):
    return {"id": kind, "name": name, "kinematics": "mecanum", "footprint": rect(length, width), "load_footprint": [],
            "max_speed_mps": speed, "max_accel_mps2": 0.4, "max_turn_rate_radps": 0.6, "max_turn_accel_radps2": 0.4,
            "min_turn_radius_m": 0, "max_arc_radius_m": 200, "clearance_m": 0.2, "height_m": height,
            "usual_code": {"kind": "apriltag", "size_m": 0.05}, "slip_sensor": {"noise_mps": 0.002},
            "motion_modes": ["auto", "self_rotation", "linear", "lateral", "oblique", "combined", "free"],
            "wheels": [wheel(n, sx * (length / 2 - 0.35), sy * (width / 2 - 0.15), True, False, 0.3)
                       for n, sx, sy in [("FL", 1, 1), ("FR", 1, -1), ("BL", -1, 1), ("BR", -1, -1)]],
            "cameras": [camera("front", camera_x)], **({"receivers": list(receivers)} if receivers else {}),
            **({"navigation_scanner": scanner} if scanner else {}),
            "scanners": scanners(rect(length, width)), "brackets": [], "mass_kg": mass, "max_load_kg": load}


MEASURING = mecanum("measuring-vehicle", "Measuring vehicle", 2.4, 1.4, 0.9, 0.9, 1.2, 900, 400,
                    scanner={"pose": pose(-0.9, 0, 0), "z_m": 2.0})  # on a mast
OMNI = mecanum("omni-mover", "Omnidirectional mover", 3.2, 2.1, 0.6, 1.2, 1.0, 1800, 3000,
               [{"name": n, "position": point(x, y), "z_m": 0.55} for n, x, y in
                [("front left", 1.5, 0.95), ("front right", 1.5, -0.95), ("rear left", -1.5, 0.95),
                 ("rear right", -1.5, -0.95)]])
OMNI["motion_modes"].insert(3, "fixed_axis_rotation")  # Wang: arcs and oblique ways
IGPS_MOVER = {**OMNI, "cameras": []}  # knows its place from transmitters alone
DELIVERY_OUTLINE = ring([(-0.8, -0.55), (0.35, -0.55), (0.66, -0.4), (0.8, 0), (0.66, 0.4), (0.35, 0.55), (-0.8, 0.55)])
DELIVERY = {
    "id": "delivery-vehicle", "name": "Delivery vehicle", "kinematics": "differential",
    "footprint": DELIVERY_OUTLINE,
    "load_footprint": [], "max_speed_mps": 1.5, "max_accel_mps2": 0.6, "max_turn_rate_radps": 0.9,
    "max_turn_accel_radps2": 0.8, "min_turn_radius_m": 0, "max_arc_radius_m": 200, "clearance_m": 0.2, "height_m": 0.4,
    "usual_code": {"kind": "landmark", "size_m": 0.08}, "slip_sensor": {"noise_mps": 0.002},
    "motion_modes": ["auto", "self_rotation", "linear", "free"],
    "wheels": [wheel("left", 0, 0.42, True, False, 0.2), wheel("right", 0, -0.42, True, False, 0.2)],
    "cameras": [camera("front", 0.5)], "scanners": scanners(DELIVERY_OUTLINE), "brackets": [], "mass_kg": 180, "max_load_kg": 250}


CHINESE = {
    "Final assembly": "总装", "Hall 3": "三号厂房", "Assembly hall": "装配厂房", "Pulse line": "脉动生产线",
    "A Pulse line": "A 脉动生产线", "B Measuring hall": "B 测量厂房", "C iGPS cell": "C iGPS 工作区",
    "D Landmark lab": "D 地标实验室", "Measuring hall": "测量厂房", "iGPS cell": "iGPS 工作区", "Landmark lab": "地标实验室",
    "North aisle": "北通道", "South aisle": "南通道", "West aisle": "西通道", "East aisle": "东通道",
    "Middle aisle": "中央通道", "Aisle to B": "通往 B 的通道", "Aisle to C and D": "通往 C 和 D 的通道",
    "Fuselage section": "机身段", "Fuselage": "机身", "Wing panel": "机翼壁板", "South gate": "南大门",
    "Conduits and cables": "管路与电缆", "Wings": "机翼", "Vertical tail": "垂尾", "Nose and final test": "机头与总检",
    "Research": "研发", "Maintenance": "检修", "Delivery": "交付", "Hand-over north": "北侧交接", "Hand-over south": "南侧交接",
    "Kit drop": "料架", "Tracker north": "北侧跟踪仪位", "Tracker south": "南侧跟踪仪位", "Tracker place": "跟踪仪位",
    "Jig north": "北侧型架", "Jig south": "南侧型架", "Jig": "型架", "Shelf north": "北侧货架", "Shelf south": "南侧货架",
    "Shelf": "货架", "Bay": "停车位", "Transport platform": "运输平台", "Measuring vehicle": "测量车",
    "Omnidirectional mover": "全向移动平台", "Delivery vehicle": "配送车"}


def named_too(thing):
    """The thing with its Chinese name beside its own; a number at the end stays."""
    words, _, last = thing["name"].rpartition(" ")
    numbered = last.isdigit() and words in CHINESE
    chinese = f"{CHINESE[words]} {last}" if numbered else CHINESE[thing["name"]]
    named = {}
    for key, value in thing.items():
        named[key] = value
        if key == "name":
            named["names"] = {"zh": chinese}
    return named


class Plant:
    def __init__(self, ident, name):
        self.ident, self.name = ident, name
        self.halls, self.stations, self.markers, self.areas = [], [], [], []
        self.transmitters, self.reflectors = [], []
        self.types, self.vehicles, self.loads, self.nodes, self.edges = [], [], [], {}, []
        self.hall = None
        self.routing = {"k_same": 10, "k_diff": 20, "reference_step_m": 1, "turn_threshold_rad": 5 * DEG}

    def add_hall(self, ident, name, width, depth, occupancy=None):
        self.hall = ident
        hall = {"id": ident, "name": name, "outline": box(0, 0, width, depth)}
        if occupancy:
            hall["occupancy_yaml"] = occupancy
        self.halls.append(hall)

    def marker(self, ident, kind, payload, size, x, y, heading, sigma=0.0001):
        self.markers.append({"id": ident, "kind": kind, "payload": payload, "size_m": size, "hall": self.hall,
                             "pose": pose(x, y, heading), "sigma_xy_m": sigma, "sigma_heading_rad": 0.0005})

    def transmit(self, places, z):
        """Transmitters that look different ways, each with a rate of its own."""
        for i, (x, y) in enumerate(places):
            heading = round(pose(x, y, 0.3 + i)["heading_rad"], 6)
            self.transmitters.append({"id": f"tx-{i + 1}", "hall": self.hall, "position": point(x, y), "z_m": z,
                                      "heading_rad": heading, "rate_hz": round(38 + 0.6 * i, 1)})

    def reflect(self, places):
        """Reflectors; no two distances alike, so that how they stand to each other tells which they are."""
        for i, (x, y) in enumerate(places):
            self.reflectors.append({"id": f"r-{i + 1:02d}", "hall": self.hall, "position": point(x, y)})

    def station(self, number, name, p, vehicle_type, rest=True, charger=False, support=False):
        ident = f"st{number:02d}"
        markers = []
        if vehicle_type is PLATFORM:
            for suffix, forward in (("F", CAMERA_X), ("B", -CAMERA_X)):
                payload = f"ST{number:02d}-{suffix}"
                markers.append(payload.lower())
                self.marker(payload.lower(), "qr", payload, 0.06, *along(p, forward), p[2])
        elif vehicle_type["cameras"]:
            kind, size = ("landmark", 0.08) if vehicle_type is DELIVERY else ("apriltag", 0.05)
            markers.append(f"{ident}-{kind}")
            x = vehicle_type["cameras"][0]["body_from_camera"]["x_m"]
            self.marker(markers[0], kind, str(number), size, *along(p, x), p[2])
        self.stations.append({
            "id": ident, "number": number, "name": name, "hall": self.hall, "pose": pose(*p),
            "tolerance": {"shape": "box", "dx_m": 0.025, "dy_m": 0.025, "dheading_rad": 0.2 * DEG},
            "markers": markers, "node": ident, "resting_place": rest, "vehicle_types": [vehicle_type["id"]]})
        if charger:
            self.stations[-1]["charger"] = True
        if support:
            self.stations[-1]["support"] = {"height_m": 0.12}
        self.node(ident, p[0], p[1])

    def node(self, ident, x, y):
        if ident not in self.nodes:
            self.nodes[ident] = {"id": ident, "hall": self.hall, "position": point(x, y)}
        return ident

    def edge(self, a, b, types=(), both=True):
        for f, t in ((a, b), (b, a)) if both else ((a, b),):
            edge = {"id": f"{f}.{t}", "from": f, "to": t}
            if types:
                edge["vehicle_types"] = [kind["id"] for kind in types]
            self.edges.append(edge)

    def chain(self, nodes, types=(), both=True):
        for a, b in zip(nodes, nodes[1:]):
            self.edge(a, b, types, both)

    def area(self, ident, kind, name, outline):
        self.areas.append({"id": ident, "kind": kind, "name": name, "hall": self.hall, "outline": outline})

    def vehicle(self, ident, vehicle_type, home, load="", load_kg=0):
        self.vehicles.append({"id": ident, "type": vehicle_type["id"], "manufacturer": "pulseline",
                              "serial_number": ident, "name": ident, "home": f"st{home:02d}"})
        if load:
            self.loads.append({"id": load, "name": load, "kind": "airframe", "model": "Trainer aircraft", "mass_kg": load_kg,
                               "vehicle": ident})

    def write(self, folder):
        halls, stations, areas, types = ([named_too(thing) for thing in things] for things in
                                         (self.halls, self.stations, self.areas, self.types))
        plant = {"$schema": "../../api/plant.schema.json", "id": self.ident,
                 **named_too({"name": self.name}), "revision": 1,
                 "halls": halls, "stations": stations, "markers": self.markers,
                 **({"transmitters": self.transmitters} if self.transmitters else {}),
                 **({"reflectors": self.reflectors} if self.reflectors else {}), "areas": areas,
                 "vehicle_types": types, "vehicles": self.vehicles,
                 **({"loads": self.loads} if self.loads else {}),
                 "roadmap": {"nodes": list(self.nodes.values()), "edges": self.edges},
                 "routing": self.routing}
        lines = []
        for key, value in plant.items():
            if key == "roadmap":
                inner = ",\n".join(f'    "{k}": [\n' + ",\n".join("      " + json.dumps(e, ensure_ascii=False) for e in v) + "\n    ]"
                                   for k, v in value.items())
                lines.append(f'  "roadmap": {{\n{inner}\n  }}')
            elif isinstance(value, list) and value:
                lines.append(f'  "{key}": [\n' + ",\n".join("    " + json.dumps(e, ensure_ascii=False) for e in value) + "\n  ]")
            else:
                lines.append(f'  "{key}": {json.dumps(value, ensure_ascii=False)}')
        (folder / f"{self.ident}.json").write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


def grid(folder, name, width, depth, columns, resolution=0.1):
    """One ring of wall cells round the hall, and columns (x0, y0, x1, y1) inside."""
    nx, ny = round(width / resolution) + 2, round(depth / resolution) + 2
    cells = [bytearray(b"\xfe" * nx) for _ in range(ny)]
    for y in range(ny):
        for x in range(nx):
            if x in (0, nx - 1) or y in (0, ny - 1):
                cells[y][x] = 0
    for x0, y0, x1, y1 in columns:
        for y in range(max(0, math.floor(y0 / resolution + 1e-6) + 1), min(ny, math.ceil(y1 / resolution - 1e-6) + 1)):
            for x in range(max(0, math.floor(x0 / resolution + 1e-6) + 1), min(nx, math.ceil(x1 / resolution - 1e-6) + 1)):
                cells[y][x] = 0
    (folder / f"{name}.pgm").write_bytes(f"P5\n{nx} {ny}\n255\n".encode() + b"".join(reversed(cells)))
    (folder / f"{name}.yaml").write_text(
        f"image: {name}.pgm\nresolution: {resolution}\norigin: [{-resolution}, {-resolution}, 0]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n")


TANG = {  # Table 4, theoretical
    1: (10, 20, 90 * DEG), 2: (20, 30, 0), 3: (30, 20, -90 * DEG), 4: (50, 20, 45 * DEG), 5: (70, 20, -90 * DEG),
    6: (85, 20, 0), 7: (95, 20, 90 * DEG)}
WORK = {1: "Conduits and cables", 2: "Wings", 3: "Vertical tail", 4: "Nose and final test", 5: "Research",
        6: "Maintenance", 7: "Delivery", 8: "Hand-over north", 9: "Hand-over south"}


def pulse_line(folder):
    p = Plant("pulse-line", "Pulse line")
    p.add_hall("line", "Assembly hall", 110, 45, "pulse-line.yaml")
    grid(folder, "pulse-line", 110, 45,
         [(x - 0.35, 0, x + 0.35, 0.6) for x in range(10, 110, 10)] +
         [(x - 0.35, 44.4, x + 0.35, 45) for x in range(10, 110, 10)])
    p.types = [far_sighted(PLATFORM)]
    for n, where in TANG.items():
        p.station(n, WORK[n], where, PLATFORM, support=n == 7)
    p.area("pulse-line", "zone", "Pulse line", box(1, 3, 105, 40))
    p.chain([f"st{n:02d}" for n in TANG])
    for edge in p.edges:
        if {edge["from"], edge["to"]} <= {"st03", "st04", "st05", "st06"}:
            edge["corridor"] = {"left_m": 11, "right_m": 11}
    p.vehicle("TP-01", PLATFORM, 1, "A-101", 18200)
    p.write(folder)


def measuring_hall(folder):
    p = Plant("measuring-hall", "Measuring hall")
    p.add_hall("hall", "Measuring hall", 45, 18)
    p.types = [MEASURING]
    for n, where in {1: (6, 14.5, 0), 2: (22, 14.5, 0), 3: (38, 14.5, 0), 4: (6, 3.5, 0), 5: (22, 3.5, 0),
                     6: (38, 3.5, 0)}.items():
        p.station(n, f"Tracker place {n}", where, MEASURING)
    p.area("fuselage", "obstacle", "Fuselage", ring([(9, 9), (12, 7.2), (34, 7.2), (35.5, 9), (34, 10.8), (12, 10.8)]))
    p.reflect([(0.15, 3.1), (0.15, 12.2), (7.3, 17.85), (15.9, 17.85), (27.4, 17.85), (37.2, 17.85), (44.85, 13.9),
               (44.85, 5.2), (40.1, 0.15), (30.6, 0.15), (19.3, 0.15), (10.2, 0.15)])
    payload = 100
    for y in (12.6, 5.4):
        for i in range(9):
            p.marker(f"tag-{payload}", "apriltag", str(payload), 0.05, 4.5 + 4.5 * i, y, 0)
            payload += 1
    north = [p.node(f"n{x}", x, 12.6) for x in (3, 6, 22, 38, 41)]
    south = [p.node(f"s{x}", x, 5.4) for x in (3, 6, 22, 38, 41)]
    p.chain(north)
    p.chain(south)
    p.edge("n3", "s3")
    p.edge("n41", "s41")
    for n, x in ((1, 6), (2, 22), (3, 38)):
        p.edge(f"n{x}", f"st{n:02d}")
        p.edge(f"s{x}", f"st{n + 3:02d}")
    p.vehicle("MV-01", MEASURING, 1)
    p.write(folder)


def landmark_lab(folder):
    p = Plant("landmark-lab", "Landmark lab")
    p.add_hall("lab", "Landmark lab", 30, 16)
    p.types = [DELIVERY]
    for n, where in {1: (5, 12, 0), 2: (15, 12, 0), 3: (25, 12, 0), 4: (5, 4, PI), 5: (15, 4, PI),
                     6: (25, 4, PI)}.items():
        p.station(n, f"Shelf {n}", where, DELIVERY)
    payload = 201
    for x in (2, 10, 20, 28):
        for y in (2, 8, 14):
            p.marker(f"landmark-{payload}", "landmark", str(payload), 0.08, x, y, PI / 2)
            payload += 1
    p.chain([p.node(f"m{x}", x, 8) for x in (5, 15, 25)])
    for n, x in ((1, 5), (2, 15), (3, 25)):
        p.edge(f"m{x}", f"st{n:02d}")
        p.edge(f"m{x}", f"st{n + 3:02d}")
    p.vehicle("DL-01", DELIVERY, 1)
    p.write(folder)


def igps_cell(folder):
    p = Plant("igps-cell", "iGPS cell")
    p.add_hall("cell", "iGPS cell", 32, 18)
    p.types = [IGPS_MOVER]
    p.transmit([(0.6, 0.6), (16, 0.5), (31.4, 0.6), (31.4, 17.4), (16, 17.5), (0.6, 17.4)], 2.6)
    for n, where in {1: (6, 12.5, -PI / 2), 2: (16, 12.5, -PI / 2), 3: (26, 12.5, -PI / 2), 4: (6, 5.5, PI / 2),
                     5: (16, 5.5, PI / 2), 6: (26, 5.5, PI / 2)}.items():
        p.station(n, f"Jig {n}", where, IGPS_MOVER)
    p.area("panel", "obstacle", "Wing panel", ring([(9, 8.4), (23, 8.6), (23, 9.4), (9, 9.6)]))
    p.chain([p.node(f"n{x}", x, 15.6) for x in (3, 6, 16, 26, 29)])
    p.chain([p.node(f"s{x}", x, 2.4) for x in (3, 6, 16, 26, 29)])
    p.edge("n3", "s3")
    p.edge("n29", "s29")
    for n, x in ((1, 6), (2, 16), (3, 26)):
        p.edge(f"n{x}", f"st{n:02d}")
        p.edge(f"s{x}", f"st{n + 3:02d}")
    p.vehicle("OM-01", IGPS_MOVER, 1)
    p.write(folder)


def final_assembly(folder):
    p = Plant("final-assembly", "Final assembly")
    p.routing["accuracy_k"] = 100
    p.add_hall("hall-3", "Hall 3", 120, 60, "final-assembly.yaml")
    columns = []
    for x in range(10, 120, 10):
        columns += [(x - 0.35, 0, x + 0.35, 0.6), (x - 0.35, 59.4, x + 0.35, 60)]
        if x not in (50,):  # the aisle to the measuring hall passes there
            columns.append((x - 0.35, 40.25, x + 0.35, 40.95))
    for y in (10, 40, 50):
        columns += [(0, y - 0.35, 0.6, y + 0.35), (119.4, y - 0.35, 120, y + 0.35)]
    grid(folder, "final-assembly", 120, 60, columns)
    p.types = [far_sighted(kind) for kind in (PLATFORM, MEASURING, OMNI, DELIVERY)]
    small = [MEASURING, OMNI, DELIVERY]

    # A: the pulse line
    for n, where in {**TANG, 8: (107, 30, PI), 9: (107, 14, PI / 2)}.items():
        p.station(n, WORK[n], where, PLATFORM, charger=n == 6, support=n == 7)
    p.station(10, "Kit drop", (114.6, 20, PI / 2), DELIVERY)
    # B: measuring hall, C: iGPS cell, D: landmark lab, and the parking bays
    xs = (8.5, 15.3, 22.1, 28.9, 35.7, 42.5)
    for i, x in enumerate(xs):
        p.station(11 + i, f"Tracker north {i + 1}", (x, 57.0, 0), MEASURING, charger=i == 5)
    for i, x in enumerate(xs):
        p.station(17 + i, f"Tracker south {i + 1}", (x, 44.0, 0), MEASURING, charger=i == 5)
    jigs = (55, 63, 71, 79)
    for i, x in enumerate(jigs):
        p.station(23 + i, f"Jig north {i + 1}", (x, 53.0, -PI / 2), OMNI, charger=i == 3)
    for i, x in enumerate(jigs):
        p.station(27 + i, f"Jig south {i + 1}", (x, 47.4, PI / 2), OMNI)
    shelves = (92, 102, 112)
    for i, x in enumerate(shelves):
        p.station(31 + i, f"Shelf north {i + 1}", (x, 55, 0), DELIVERY)
    for i, x in enumerate(shelves):
        p.station(34 + i, f"Shelf south {i + 1}", (x, 46, PI), DELIVERY)
    bays = (66, 72, 78, 84)
    for i, x in enumerate(bays):
        p.station(37 + i, f"Bay {i + 1}", (x, 1.5, PI), DELIVERY, charger=True)

    p.area("zone-a", "zone", "A Pulse line", box(4.6, 5.6, 115.6, 36.4))
    p.area("zone-b", "zone", "B Measuring hall", box(2.5, 42, 47.5, 58.6))
    p.area("zone-c", "zone", "C iGPS cell", box(51, 42, 83, 58.6))
    p.area("zone-d", "zone", "D Landmark lab", box(87, 42, 118, 58.6))
    p.area("lane-north", "lane", "North aisle", box(2, 36.7, 118.6, 39.3))
    p.area("lane-south", "lane", "South aisle", box(2, 2.9, 118.6, 5.1))
    p.area("lane-west", "lane", "West aisle", box(2, 2.9, 4.2, 39.3))
    p.area("lane-east", "lane", "East aisle", box(116.1, 2.9, 118.3, 39.3))
    p.area("lane-middle", "lane", "Middle aisle", box(56.4, 2.9, 58.6, 39.3))
    p.area("lane-b", "lane", "Aisle to B", box(48.4, 36.7, 50.2, 58))
    p.area("lane-c", "lane", "Aisle to C and D", box(83.9, 36.7, 86.1, 58.2))
    for i, x in enumerate(bays):
        p.area(f"bay-{i + 1}", "zone", f"Bay {i + 1}", box(x - 1.7, 0.35, x + 1.7, 2.65))
    p.area("fuselage", "obstacle", "Fuselage section",
           ring([(12, 50.5), (12.8, 49.2), (15, 48.7), (18, 48.6), (36, 48.6), (37.3, 49.3), (37.6, 50.5),
                 (37.3, 51.7), (36, 52.4), (18, 52.4), (15, 52.3), (12.8, 51.8)]))
    p.area("wing-panel", "obstacle", "Wing panel", ring([(60, 49.6), (74.5, 49.8), (74.5, 50.6), (60, 50.8)]))
    p.area("gate-south", "no_go", "South gate", box(58, 0, 62, 2.2))

    p.transmit([(51.4, 42.4), (82.6, 42.4), (82.6, 58.2), (51.4, 58.2)], 2.8)
    # On the walls all round, and on the columns between the measuring hall and the pulse line.
    p.reflect([(3.2, 59.85), (12.7, 59.85), (24.1, 59.85), (33.8, 59.85), (45.3, 59.85), (58.2, 59.85), (69.4, 59.85),
               (81.3, 59.85), (93.6, 59.85), (107.1, 59.85), (119.85, 53.3), (119.85, 44.7), (119.85, 33.2),
               (119.85, 24.3), (119.85, 12.6), (103.3, 0.15), (92.8, 0.15), (48.6, 0.15), (37.9, 0.15), (26.7, 0.15),
               (13.4, 0.15), (0.15, 8.3), (0.15, 17.2), (0.15, 27.9), (0.15, 34.1), (0.15, 43.6), (0.15, 52.9),
               (10.2, 41.1), (19.8, 41.1), (30.1, 41.1), (39.8, 41.1)])
    payload = 100
    for y in (55.7, 52.9, 48.1, 45.3):
        for i in range(9):
            p.marker(f"tag-{payload}", "apriltag", str(payload), 0.05, 5.1 + 5.1 * i, y, 0)
            payload += 1
    payload = 201
    for x in (89, 97, 107, 116):
        for y in (44, 50.5, 57):
            p.marker(f"landmark-{payload}", "landmark", str(payload), 0.08, x, y, PI / 2)
            payload += 1

    # The ring of aisles runs counter-clockwise, one way; the others both ways.
    south = [p.node("sw", 3.1, 4)] + [p.node(f"s{x}", x, 4) for x in (30, 57.5, 66, 72, 78, 84)] + [p.node("se", 117.2, 4)]
    north = [p.node("ne", 117.2, 38)] + [p.node(f"n{x}", x, 38) for x in (85, 57.5, 49.3, 30)] + [p.node("nw", 3.1, 38)]
    p.chain(south, small, both=False)
    p.chain(["se", p.node("e20", 117.2, 20), "ne"], small, both=False)
    p.chain(north, small, both=False)
    p.chain(["nw", p.node("w20", 3.1, 20), "sw"], small, both=False)
    p.edge("s57.5", "n57.5", small, both=False)
    p.edge("e20", "st10", [DELIVERY])
    for i, x in enumerate(bays):
        p.edge(f"s{x}", f"st{37 + i}", [DELIVERY])
    # B
    p.node("b-south", 49.3, 46.6)
    p.node("b-north", 49.3, 54.4)
    p.chain(["n49.3", "b-south", "b-north"], small)
    for row, first, y in (("north", 11, 54.4), ("south", 17, 46.6)):
        nodes = [p.node(f"b-{row}-{i + 1}", x, y) for i, x in enumerate(xs)]
        p.chain(nodes + [f"b-{row}"], [MEASURING])
        for i, node in enumerate(nodes):
            p.edge(node, f"st{first + i}", [MEASURING])
    p.edge("b-north-1", "b-south-1", [MEASURING])
    # C and D
    for ident, y in (("c-south", 43.2), ("d", 50.5), ("c-north", 57.2)):
        p.node(ident, 85, y)
    p.chain(["n85", "c-south", "d", "c-north"], small)
    for row, first, y in (("north", 23, 57.2), ("south", 27, 43.2)):
        nodes = [p.node(f"c-{row}-{i + 1}", x, y) for i, x in enumerate(jigs)]
        p.chain(nodes + [f"c-{row}"], [OMNI])
        for i, node in enumerate(nodes):
            p.edge(node, f"st{first + i}", [OMNI])
    nodes = ["d"] + [p.node(f"d-{i + 1}", x, 50.5) for i, x in enumerate(shelves)]
    p.chain(nodes, [DELIVERY])
    for i, node in enumerate(nodes[1:]):
        p.edge(node, f"st{31 + i}", [DELIVERY])
        p.edge(node, f"st{34 + i}", [DELIVERY])
    # The platforms' own way, and the gate in the west where they come in.
    p.chain([f"st{n:02d}" for n in range(1, 10)], [PLATFORM])
    p.edge("st07", "st09", [PLATFORM])
    p.edge("w20", "st01", [PLATFORM])

    p.vehicle("TP-01", PLATFORM, 1, "A-103", 18200)
    p.vehicle("TP-02", PLATFORM, 8, "A-102", 18450)
    p.vehicle("TP-03", PLATFORM, 9, "A-101", 18600)
    for ident, home in (("MV-01", 14), ("MV-02", 19), ("MV-03", 11)):
        p.vehicle(ident, MEASURING, home)
    for ident, home in (("OM-01", 27), ("OM-02", 24), ("OM-03", 30)):
        p.vehicle(ident, OMNI, home)
    for ident, home in (("DL-01", 34), ("DL-02", 38), ("DL-03", 39)):
        p.vehicle(ident, DELIVERY, home)
    p.write(folder)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parents[2] / "db/plants")
    for make in (pulse_line, measuring_hall, landmark_lab, igps_cell, final_assembly):
        make(folder)


if __name__ == "__main__":
    main()
