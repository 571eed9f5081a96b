// @ts-check
// The arena: map, camera, robots, and what operators ask of them.
import { Ghosts } from "../arena/ghosts.js";
import { History } from "../arena/history.js";
import { Parameters } from "../arena/parameters.js";
import { PathPlan } from "../arena/path_plan.js";
import { RobotCharts } from "../arena/robot_charts.js";
import { CameraView } from "../arena/camera.js";
import { ArenaMap } from "../arena/map.js";
import { RobotTable } from "../arena/table.js";

/** @type {(id: string) => any} */
const $ = (id) => document.getElementById(id);

/** @typedef {import("../messages").LiveRobot} LiveRobot */
/** @typedef {import("../messages").World} World */

export class ArenaRoom {
  /** @param {{ send: import("../messages").Send, commands: boolean }} page */
  constructor(page) {
    this.id = "arena";
    this.page = page;
    /** @type {number | null} */
    this.selected = null;
    /** @type {World | null} */
    this.world = null;
    /** @type {import("../messages").FloorErrors | null} */
    this.errors = null;
    this.recording = /** @type {string | null} */ (null);
    this.map = new ArenaMap($("map"), (...where) => this.point(...where));
    this.map.ghosts = this.ghosts = new Ghosts();
    this.history = new History();
    this.charts = new RobotCharts($("charts"));
    this.parameters = new Parameters($("parameters"), $("parameters-hint"), page);
    this.plan = new PathPlan($("path"), () => this.showPlan());
    this.camera = new CameraView($("camera"));
    this.table = new RobotTable($("table"), (id) => this.select(id));
    this.listen();
    this.listenForErrors();
    this.listenForPaths();
  }

  listen() {
    const { page } = this;
    $("release").addEventListener("click", () => page.send("Release"));
    $("resume").addEventListener("click", () => this.order("Resume"));
    $("record").addEventListener("click", () =>
      page.send(this.recording ? "StopRecording" : "StartRecording"));
    $("scenario-form").addEventListener("submit", (event) => {
      event.preventDefault();
      page.send("ChooseScenario", { name: $("scenario").value, robots: Number($("robots").value) });
    });
    $("halt").addEventListener("click", () => this.order("Halt"));
    addEventListener("keydown", (event) => {
      if (event.code === "Escape" && this.isOpen) this.select(null);
    });
  }

  /** @param {"Halt" | "Resume"} type of what the selected robot shall do */
  order(type) {
    if (this.selected !== null) this.page.send(type, { robot_id: this.selected });
  }

  listenForErrors() {
    $("measure-errors").addEventListener("click", () => {
      $("show-errors").checked = true;
      this.page.send("MeasureErrors");
    });
    $("show-errors").addEventListener("change", () => this.showErrors());
  }

  listenForPaths() {
    $("path-form").addEventListener("submit", (event) => {
      event.preventDefault();
      const { points } = this.plan;
      if (this.selected === null || !points?.length) return;
      this.page.send("FollowPath", { robot_id: this.selected, points_m: points });
      this.plan.clear();
    });
    $("path-clear").addEventListener("click", () => this.plan.clear());
    $("path-draw").addEventListener("click", () => {
      this.isDrawing = !this.isDrawing;
      $("path-draw").setAttribute("aria-pressed", String(this.isDrawing));
    });
  }

  open() { this.isOpen = true; }
  close() { this.isOpen = false; }

  /** @param {import("../messages").Welcome} message */
  welcome(message) {
    this.map.half = message.floor_m;
    this.startAnew();
    this.showErrors();
    $("scenario").replaceChildren(...message.scenarios.map((name) => new Option(name, name)));
  }

  lost() {}

  /** @param {import("../messages").Told} message */
  take(message) {
    if (message.type === "World") this.showWorld(message);
    if (message.type === "Picture" && this.isOpen) return this.showPicture(message);
    if (message.type === "Stage") this.showStage(message);
    if (message.type === "FloorErrors") this.takeErrors(message);
    if (message.type === "Health") this.showRecording(message.recording);
  }

  startAnew() {
    this.map.clear();
    this.camera.clear();
    this.table.clear();
    this.ghosts.clear();
    this.history.clear();
  }

  /** @param {import("../messages").Stage} message */
  showStage(message) {
    this.map.stage = message;
    if (document.activeElement !== $("scenario")) $("scenario").value = message.scenario;
    this.parameters.take(message.parameters);
  }

  /** @param {import("../messages").FloorErrors} message */
  takeErrors(message) {
    this.errors = message;
    this.showErrors();
  }

  showErrors() {
    const known = this.errors?.errors ?? [];
    $("measure-errors").disabled = !this.page.commands || Boolean(this.errors?.is_measuring);
    $("show-errors").disabled = !known.length;
    this.map.errors = $("show-errors").checked && known.length ? this.errors : null;
    $("errors-say").textContent = this.errors ? errorsTold(this.errors) : "";
    this.map.draw();
  }

  showPlan() {
    this.map.plan = this.plan.points ?? [];
    this.map.draw();
  }

  /** @param {World} message */
  showWorld(message) {
    if (this.world && message.time_s < this.world.time_s) this.startAnew();
    this.world = message;
    this.ghosts.take(message.robots);
    const isTime = this.history.take(message, this.ghosts);
    if (isTime && this.isOpen) this.charts.draw(this.history, this.selected);
    this.map.take(message);
    this.table.take(message, this.selected);
    $("map-hint").textContent = message.missing.length
      ? `Never seen yet: ${message.missing.join(", ")}` : "Trails, headings, neighbour links.";
    $("table-hint").hidden = message.robots.length > 0;
    $("release").disabled = !this.page.commands || !message.is_stopped;
    document.body.dataset.places = message.robots.map((one) =>
      [one.id, one.x_m.toFixed(4), one.y_m.toFixed(4), one.speed_mps.toFixed(3)].join(" ")).join(";");
    this.showSelected();
  }

  async showPicture(message) {
    await this.camera.take(message);
    $("camera-hint").textContent = `${message.markers.length} markers found`;
  }

  showRecording(recording) {
    this.recording = recording;
    $("record").textContent = recording ? "End recording" : "Record";
    $("record").setAttribute("aria-pressed", String(Boolean(recording)));
  }

  point(x, y, robot, isShifted) {
    const [a, b] = this.map.half, isOnFloor = Math.abs(x) <= a && Math.abs(y) <= b;
    if (isShifted || this.isDrawing) return isOnFloor && this.plan.add(x, y);
    if (robot !== null) return this.select(robot);
    if (this.selected !== null && this.page.commands && isOnFloor) {
      this.page.send("GoTo", { robot_id: this.selected, x_m: x, y_m: y });
    }
  }

  select(id) {
    this.selected = this.selected === id ? null : id;
    this.map.selected = this.selected;
    this.charts.draw(this.history, this.selected);
    this.showSelected();
  }

  showSelected() {
    const one = this.world?.robots.find((robot) => robot.id === this.selected);
    const { commands } = this.page;
    $("map").classList.toggle("armed", Boolean(one) && commands);
    for (const id of ["halt", "path-send"]) $(id).disabled = !commands || !one;
    $("resume").disabled = !commands || !one || one.task === "own";
    $("selected").textContent = one ? told(one, commands, this.ghosts.off(one))
      : "Select a robot on the map or in the table; then click where it shall go.";
  }
}

/** @param {LiveRobot} one */
function told(one, commands, off) {
  const wheels = off ? `; its wheels are ${(1000 * off.off_m).toFixed(1)} mm and `
    + `${(off.turned_rad * 180 / Math.PI).toFixed(1)}° off the camera` : "";
  const where = `${one.x_m.toFixed(3)}, ${one.y_m.toFixed(3)} m`;
  return `${one.name} at ${where}, ${one.neighbours.length} neighbours${wheels}. ` +
    (commands ? "Click on the map where it shall go; with shift, through which points." : "");
}

function errorsTold({ is_measuring: isMeasuring, errors, height_m: height }) {
  if (isMeasuring) return "The floor is being measured: some seconds…";
  if (!errors.length) return "The floor could not be measured; try again.";
  const radial = errors.map(([, , x, y]) => Math.hypot(x, y)), mm = (value) => (1000 * value).toFixed(3);
  const rms = (values) => Math.sqrt(values.reduce((sum, one) => sum + one * one, 0) / values.length);
  return `${errors.length} places, ${(100 * height).toFixed(0)} cm above the floor: radial error `
    + `${mm(rms(radial))} mm rms, ${mm(Math.max(...radial))} mm at worst; `
    + `±${mm(rms(errors.map((one) => one[4])))} mm stated`;
}
