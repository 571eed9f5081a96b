// What the server and the page say to each other, for editors and checkers of types.
// Written by docs/make_pages.py from tagmetry.live.messages. Numbers that are not finite are null.

/** The first message on every connection: who you are, and what there is. */
export interface Welcome {
  type: "Welcome";
  /** What this page may do. */
  role: "viewer" | "operator";
  /** That can be chosen. */
  scenarios: string[];
  /** Half the floor's extent along x and y. */
  floor_m: [number, number];
  /** How often a page that drives says that it is there. */
  beat_s: number;
}

/** One robot. */
export interface LiveRobot {
  /** Its own number. */
  id: number;
  /** What people call it; any text. */
  name: string;
  /** Its centre in the world. */
  x_m: number;
  /** Its centre in the world. */
  y_m: number;
  /** From the world's x, counter-clockwise. */
  heading_rad: number;
  /** Along its forward axis. */
  speed_mps: number;
  /** Of the circle that it stays in. */
  radius_m: number;
  /** Of its place, one standard deviation: long and short half axis, m, and the long one's direction, rad. */
  ellipse: [number, number, number];
  /** Since the last image that showed it. */
  age_s: number;
  /** The newest image shows it. */
  is_seen: boolean;
  /** It has to stand still. */
  is_stopped: boolean;
  /** The reasons, in words. */
  why: string;
  /** "own" while its controller drives; else what a person asked: to visit a place, to walk a path, to wait. */
  task: "own" | "visit" | "walk" | "wait";
  /** (x, y) of the way points that a person gave, the goal last; none otherwise. */
  path_m: [number, number][];
  /** (x, y, heading) as its wheels say, in its own frame; None before it told. */
  odometry: [number, number, number] | null;
  /** How fast its left and its right wheel turn, by its encoders; None before. */
  wheels_radps: [number, number] | null;
  /** As it told last; None before. */
  battery_v: number | null;
  /** Share of its packets that did not arrive. */
  loss: number;
  /** To the host and back; None before it was measured. */
  round_trip_s: number | null;
  /** Ids of the robots that it senses. */
  neighbours: number[];
}

/** Where all robots are. */
export interface World {
  type: "World";
  /** In the arena's clock. */
  time_s: number;
  /** By rising id; robots that were never seen are not among them. */
  robots: LiveRobot[];
  /** Names of the robots that were never seen. */
  missing: string[];
  /** The stop for all is pressed. */
  is_stopped: boolean;
  /** Who or what pressed it. */
  why: string;
}

/** A number of the controllers that can be changed. */
export interface LiveParameter {
  /** With its unit. */
  name: string;
  /** As it is set. */
  value: number;
  /** That can be set. */
  least: number;
  /** That can be set. */
  most: number;
  /** In words. */
  meaning: string;
}

/** What robots are among, and what can be set; told when it changes. */
export interface Stage {
  type: "Stage";
  /** What runs. */
  scenario: string;
  /** Of the robots' sensor for neighbours, from centre to centre. */
  reach_m: number;
  /** (x, y) of the corners that robots stay within; none where there is no fence. */
  fence_m: [number, number][];
  /** Virtual obstacles: x, y and radius, m. */
  discs: [number, number, number][];
  /** Virtual obstacles: x and y of both ends, m. */
  walls: [number, number, number, number][];
  /** Of the controllers. */
  parameters: LiveParameter[];
}

/** A marker in the camera's picture. */
export interface LiveMarker {
  /** Whose. */
  robot_id: number;
  /** In the picture as it is sent, clockwise from the marker's top left. */
  corners_px: [number, number][];
  /** A point before the robot, seen from the marker's centre. */
  front_px: [number, number];
}

/** What the camera sees; on its way the JPEG follows the JSON in one binary message. */
export interface Picture {
  type: "Picture";
  /** When it was taken, in the arena's clock. */
  time_s: number;
  /** The same in a clock of the server; `Seen` tells it back. */
  taken_s: number;
  /** Of the picture as it is sent. */
  width_px: number;
  /** Of the picture as it is sent. */
  height_px: number;
  /** That were found in it. */
  markers: LiveMarker[];
  /** The picture. */
  jpeg: Blob;
}

/** How long one step of an image's way takes. */
export interface StageTime {
  /** As people call it. */
  name: string;
  /** The mean of the last second. */
  mean_s: number;
}

/** How the measurement does. */
export interface Health {
  type: "Health";
  /** What runs. */
  scenario: string;
  /** Images measured per second of the wall's clock. */
  image_rate_hz: number;
  /** How far the arena is behind the wall's clock. */
  late_s: number;
  /** Time that one image takes, the mean of the last second. */
  turn_s: number;
  /** Pictures made per second. */
  picture_rate_hz: number;
  /** Since the newest picture was taken; None before. */
  picture_age_s: number | null;
  /** Pages that are connected. */
  viewers: number;
  /** Name of the file that is being written; None while nothing is. */
  recording: string | null;
  /** What went wrong last; empty while all is well. */
  notice: string;
  /** The steps of an image's way. */
  stages: StageTime[];
  /** Share of packets that do not arrive, of the robot that loses most. */
  worst_loss: number;
  /** Of the robot that has least; None before one told. */
  least_battery_v: number | null;
  /** That the arena's program holds; None where the system does not say. */
  memory_bytes: number | null;
  /** Where recordings go; None where that is not known. */
  disk_free_bytes: number | null;
  /** What the recording could not write in time. */
  dropped_count: number;
  /** What is wrong and what to do, a line each; none while all is well. */
  advice: string[];
}

/** How messages reach the pages. */
export interface Delivery {
  type: "Delivery";
  /** That are connected. */
  pages: number;
  /** Messages per second that pages took, all together. */
  told_hz: number;
  /** Messages per second that a newer one replaced before a slow page took them. */
  missed_hz: number;
  /** From an image until a page shows its picture, the newest 200 times, as pages say; None before. */
  shown_median_s: number | null;
  /** What 99 of 100 do not exceed. */
  shown_p99_s: number | null;
}

/** How far measured places are off over the floor, as `MeasureErrors` found it. */
export interface FloorErrors {
  type: "FloorErrors";
  /** It is being found out; nothing is known yet. */
  is_measuring: boolean;
  /** Between the places. */
  step_m: number;
  /** Of the markers above the floor. */
  height_m: number;
  /** One for each place: x, y, the error along x and along y, and the stated standard deviation, m. */
  errors: [number, number, number, number, number][];
}

/** What the page asked for last was not done. */
export interface Refused {
  type: "Refused";
  /** In words. */
  why: string;
}

/** What the camera to be calibrated sees. */
export interface CalibrationPicture {
  type: "CalibrationPicture";
  /** Of the picture as it is sent. */
  width_px: number;
  /** Of the picture as it is sent. */
  height_px: number;
  /** Of the board that was found in it; empty where none was. */
  corners_px: [number, number][];
  /** Where the board's edge is wanted next, clockwise; null where the lens shows nothing. */
  outline_px: [number, number][];
  /** The picture's file; it goes behind the JSON of the others. */
  jpeg: Blob;
}

/** A number of the camera. */
export interface CalibrationNumber {
  /** `fx`, `cx`, `k1` and so on. */
  name: string;
  /** In pixels, or without a unit. */
  value: number;
  /** Its standard deviation. */
  sd: number;
}

/** A camera, and what it is worth. */
export interface CalibrationResult {
  /** Its model. */
  lens: string;
  /** What was solved. */
  numbers: CalibrationNumber[];
  /** Error of the views that it rests on. */
  rms_px: number;
  /** Error of views that were left out in turn. */
  hold_out_px: number;
  /** Largest standard deviation of projections over the image. */
  worst_px: number;
  /** good, usable or poor. */
  grade: string;
  /** The verdict in sentences. */
  words: string;
  /** What the camera can be used for. */
  fit_for: string[];
  /** What is weak, the worst first. */
  doubts: string[];
  /** There is a report to download. */
  has_report: boolean;
}

/** How far the calibration is. */
export interface CalibrationState {
  type: "CalibrationState";
  /** What goes on; `failed` says why in `why`. */
  phase: "looking" | "solving" | "done" | "failed";
  /** That is calibrated. */
  camera: string;
  /** In one line. */
  board: string;
  /** Uncertainty to be reached at the worst place of the image. */
  wanted_px: number;
  /** What to do now, in words. */
  advice?: string;
  /** Why the newest image was not taken, or what failed; empty where nothing did. */
  why?: string;
  /** At the worst place of the image, after each view taken. */
  uncertainty_px?: number[];
  /** How many corners were seen in each cell of the image, 6 rows of 8. */
  coverage?: number[][];
  /** The camera; None before it is solved. */
  result?: CalibrationResult | null;
  /** Name of the files that it was saved as; empty before. */
  saved?: string;
}

/** The newest image. */
export interface LensPicture {
  type: "LensPicture";
  /** Of the picture as it is sent. */
  width_px: number;
  /** Of the picture as it is sent. */
  height_px: number;
  /** Of the marker; empty where it was not seen. */
  corners_px: [number, number][];
  /** The picture's file; it goes behind the JSON of the others. */
  jpeg: Blob;
}

/** One image. */
export interface LensPoint {
  /** When it was taken, in the camera's clock. */
  time_s: number;
  /** In effect for it. */
  zoom_percent: number;
  /** In effect for it, the camera's own unit. */
  focus: number;
  /** Of the marker; null where it was not seen. */
  depth_m: number;
  /** Its standard deviation. */
  depth_sd_m: number;
  /** The depth as the simulation has it. */
  true_m: number;
}

/** What the lens has done so far. */
export interface LensTrace {
  type: "LensTrace";
  /** Of the newest image. */
  phase: "preparing" | "scan" | "iterate" | "average" | "track" | "reacquire" | "ended";
  /** The newest images, the oldest first. */
  points: LensPoint[];
  /** Since the beginning. */
  images: number;
  /** When the first final measurement was there; null before. */
  converged_s: number;
  /** Why there is no measurement, or why it ended; empty otherwise. */
  why: string;
}

/** A marker of the map. */
export interface LocateMarker {
  /** Of its family. */
  id: number;
  /** Its left end from above, (x, y) in the world. */
  left_m: [number, number];
  /** Its right end. */
  right_m: [number, number];
}

/** Where the camera was. */
export interface LocatePoint {
  /** In the world. */
  x_m: number;
  /** In the world. */
  y_m: number;
  /** Above the floor. */
  z_m: number;
  /** Where it looks, from the world's x, counter-clockwise. */
  heading_rad: number;
  /** Of (x, y), one standard deviation: long and short half axis, m, and the long one's direction, rad. */
  ellipse: [number, number, number];
  /** Standard deviations of x, y and z. */
  sd_m: [number, number, number];
  /** Of the turns about x, y and z. */
  sd_rad: [number, number, number];
  /** (x, y, z) as the simulation has it; None where nobody knows. */
  true_m: [number, number, number] | null;
  /** Squared error by its covariance, six numbers together; 6 on average; None where the truth is not known. */
  mahalanobis2: number | null;
}

/** What a marker of the newest image says. */
export interface LocateResidual {
  /** Of its family. */
  id: number;
  /** From the camera. */
  distance_m: number;
  /** Between its corners and where the pose puts them. */
  rms_px: number;
  /** The pose rests on it. */
  is_used: boolean;
  /** Why not; empty where it does. */
  why: string;
}

/** How a camera found its way. */
export interface LocateTrace {
  type: "LocateTrace";
  /** Images still come. */
  is_running: boolean;
  /** The map. */
  markers: LocateMarker[];
  /** The newest places, the oldest first. */
  path: LocatePoint[];
  /** Of the newest image. */
  residuals: LocateResidual[];
  /** Why the newest image has no place, or why it ended; empty otherwise. */
  why: string;
}

/** The page that drives is open and looked at; without it for 300 ms, all robots stop. */
export interface Beat {
  type: "Beat";
}

/** The page shows a picture; it gets the next one only then, once it has said so. */
export interface Seen {
  type: "Seen";
  /** The picture's. */
  taken_s: number;
}

/** Stop all robots, and keep them stopped; who may look may stop. */
export interface Stop {
  type: "Stop";
  /** Who or what asks for it. */
  why?: string;
}

/** Let all robots move again. */
export interface Release {
  type: "Release";
}

/** Send a robot to a place, where it stays until it is resumed. */
export interface GoTo {
  type: "GoTo";
  /** Which. */
  robot_id: number;
  /** In the world. */
  x_m: number;
  /** In the world. */
  y_m: number;
}

/** Send a robot through points; it stays at the last until it is resumed. */
export interface FollowPath {
  type: "FollowPath";
  /** Which. */
  robot_id: number;
  /** (x, y) in the world, 1 to 40 of them. */
  points_m: [number, number][];
}

/** Let one robot stand still until it is resumed. */
export interface Halt {
  type: "Halt";
  /** Which. */
  robot_id: number;
}

/** Give a robot that was sent somewhere, or halted, back to its controller. */
export interface Resume {
  type: "Resume";
  /** Which. */
  robot_id: number;
}

/** Change a number of all controllers that have it. */
export interface SetParameter {
  type: "SetParameter";
  /** One of those that the stage lists. */
  name: string;
  /** Within its range. */
  value: number;
}

/** Begin another scenario. */
export interface ChooseScenario {
  type: "ChooseScenario";
  /** One of those that the welcome lists. */
  name: string;
  /** How many. */
  robots: number;
}

/** Measure the simulated floor's error map. */
export interface MeasureErrors {
  type: "MeasureErrors";
}

/** Record states and pictures into a new file, which the server names. */
export interface StartRecording {
  type: "StartRecording";
}

/** End the recording. */
export interface StopRecording {
  type: "StopRecording";
}

/** Look at a board and take views of it. */
export interface StartCalibration {
  type: "StartCalibration";
  /** In one line, like `charuco:7x5:30mm:22mm:5x5_100`. */
  board: string;
  /** To be reached at the worst place of the image, like `0.5px`. */
  uncertainty: string;
}

/** Take no more views, and solve from those that were taken. */
export interface EndCalibration {
  type: "EndCalibration";
}

/** Write the camera's file and its report into the server's folder. */
export interface SaveCalibration {
  type: "SaveCalibration";
  /** Of the files, without a suffix: letters, digits, - and _. */
  name: string;
}

/** Look for a simulated 10 mm marker and measure it. */
export interface StartLens {
  type: "StartLens";
  /** Where it stands, or about where it moves. */
  depth_m: number;
  /** How far it is turned about its upright axis. */
  turn_deg: number;
  /** It moves to and fro, and is followed. */
  tracks: boolean;
}

/** Leave the lens where it is. */
export interface StopLens {
  type: "StopLens";
}

/** Carry a simulated camera round a room with markers on its walls. */
export interface StartLocate {
  type: "StartLocate";
  /** Standard deviation of every corner's coordinate. */
  noise_px: number;
}

/** Say where a camera was from images that it took; all lie in the server's folder of maps. */
export interface LocateImages {
  type: "LocateImages";
  /** Of the marker map's file. */
  map_name: string;
  /** Of the intrinsics' file. */
  camera: string;
  /** Of a recording, a video, or a folder of pictures. */
  images: string;
}

/** Stop it. */
export interface StopLocate {
  type: "StopLocate";
}

export type Told =
  | Welcome
  | World
  | Stage
  | Picture
  | Health
  | Delivery
  | FloorErrors
  | Refused
  | CalibrationPicture
  | CalibrationState
  | LensPicture
  | LensTrace
  | LocateTrace;

export type Asked =
  | Beat
  | Seen
  | Stop
  | Release
  | GoTo
  | FollowPath
  | Halt
  | Resume
  | SetParameter
  | ChooseScenario
  | MeasureErrors
  | StartRecording
  | StopRecording
  | StartCalibration
  | EndCalibration
  | SaveCalibration
  | StartLens
  | StopLens
  | LocateImages
  | StartLocate
  | StopLocate;

/** Sends what a page asks for: its type, and its other fields. */
export type Send = <T extends Asked["type"]>(
  type: T, fields?: Omit<Extract<Asked, { type: T }>, "type">) => boolean;
