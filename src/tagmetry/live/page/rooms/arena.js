// The arena: map, camera, robots, and what operators ask of them.
import { CameraView } from "../camera.js";
import { ArenaMap } from "../map.js";
import { RobotTable } from "../table.js";

const $ = (id) => document.getElementById(id);

export class ArenaRoom {
  constructor(page) {
    this.id = "arena";
    this.page = page;
    this.selected = this.world = this.recording = null;
    this.map = new ArenaMap($("map"), (x, y, robot) => this.point(x, y, robot));
    this.camera = new CameraView($("camera"));
    this.table = new RobotTable($("table"), (id) => this.select(id));
    this.listen();
  }

  listen() {
    const { page } = this;
    $("release").addEventListener("click", () => page.send("Release"));
    $("resume").addEventListener("click", () => page.send("Resume", { robot_id: this.selected }));
    $("record").addEventListener("click", () =>
      page.send(this.recording ? "StopRecording" : "StartRecording"));
    $("scenario-form").addEventListener("submit", (event) => {
      event.preventDefault();
      page.send("ChooseScenario", { name: $("scenario").value, robots: Number($("robots").value) });
    });
    addEventListener("keydown", (event) => {
      if (event.code === "Escape" && this.isOpen) this.select(null);
    });
  }

  open() { this.isOpen = true; }
  close() { this.isOpen = false; }

  welcome(message) {
    this.map.half = message.floor_m;
    this.startAnew();
    $("scenario").replaceChildren(...message.scenarios.map((name) => new Option(name, name)));
  }

  lost() {}

  take(message) {
    if (message.type === "World") this.showWorld(message);
    if (message.type === "Picture" && this.isOpen) return this.showPicture(message);
    if (message.type === "Health") this.showRecording(message.recording);
  }

  startAnew() {
    this.map.clear();
    this.camera.clear();
    this.table.clear();
  }

  showWorld(message) {
    if (this.world && message.time_s < this.world.time_s) this.startAnew();
    this.world = message;
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

  point(x, y, robot) {
    if (robot !== null) return this.select(robot);
    const [a, b] = this.map.half, isOnFloor = Math.abs(x) <= a && Math.abs(y) <= b;
    if (this.selected !== null && this.page.commands && isOnFloor) {
      this.page.send("GoTo", { robot_id: this.selected, x_m: x, y_m: y });
    }
  }

  select(id) {
    this.selected = this.selected === id ? null : id;
    this.map.selected = this.selected;
    this.showSelected();
  }

  showSelected() {
    const one = this.world?.robots.find((robot) => robot.id === this.selected);
    const { commands } = this.page;
    $("map").classList.toggle("armed", Boolean(one) && commands);
    $("resume").disabled = !commands || !one || one.task === "own";
    $("selected").textContent = one ? told(one, commands)
      : "Select a robot on the map or in the table; then click where it shall go.";
  }
}

function told(one, commands) {
  const wheels = one.odometry
    ? `; its wheels say ${one.odometry.map((v) => v.toFixed(3)).join(", ")}` : "";
  const where = `${one.x_m.toFixed(3)}, ${one.y_m.toFixed(3)} m`;
  return `${one.name} at ${where}, ${one.neighbours.length} neighbours${wheels}. ` +
    (commands ? "Click on the map where it shall go." : "");
}
