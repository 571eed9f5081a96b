// Joins the page: messages to views, buttons and keys to messages.
import { CameraView } from "./camera.js";
import { Link } from "./link.js";
import { ArenaMap } from "./map.js";
import { RobotTable } from "./table.js";

const $ = (id) => document.getElementById(id);
const OPERATORS = ["stop", "release", "record", "scenario", "robots", "begin"];
let role = "viewer", selected = null, world = null, recording = null, beating = null;

const map = new ArenaMap($("map"), (x, y, robot) => {
  if (robot !== null) return select(robot);
  const [a, b] = map.half;
  if (selected !== null && role === "operator" && Math.abs(x) <= a && Math.abs(y) <= b) {
    link.send("GoTo", { robot_id: selected, x_m: x, y_m: y });
  }
});
const camera = new CameraView($("camera"));
const table = new RobotTable($("table"), select);
const link = new Link(take, showState);

function take(message) {
  const takers = { Welcome: welcome, World: showWorld, Picture: showPicture, Health: showHealth,
    Refused: (one) => notice(one.why) };
  takers[message.type]?.(message);
}

function welcome(message) {
  role = message.role;
  map.half = message.floor_m;
  startAnew();
  $("sign-in").hidden = role === "operator";
  $("shelf").hidden = role !== "operator";
  for (const id of OPERATORS) $(id).disabled = role !== "operator";
  $("scenario").replaceChildren(...message.scenarios.map((name) => new Option(name, name)));
  clearInterval(beating);
  if (role === "operator") beating = setInterval(beat, 1000 * message.beat_s);
  showState("live");
}

function startAnew() {
  map.clear();
  camera.clear();
  table.clear();
}

// A page that nobody looks at says nothing: the server then stops what it drives.
function beat() {
  if (!document.hidden) link.send("Beat");
}

function showState(state) {
  const texts = { live: role === "operator" ? "live · you command" : "live · looking only",
    lost: "connection lost; trying again…", "sign in": "sign in to see" };
  $("connection").textContent = texts[state];
  $("connection").className = state === "live" ? "live" : "lost";
  if (state === "sign in") $("sign-in").hidden = false;
  if (state !== "live") for (const id of [...OPERATORS, "resume"]) $(id).disabled = true;
}

function showWorld(message) {
  if (world && message.time_s < world.time_s) startAnew();
  world = message;
  map.take(message);
  table.take(message, selected);
  $("map-hint").textContent = message.missing.length
    ? `Never seen yet: ${message.missing.join(", ")}` : "Trails, headings, neighbour links.";
  $("table-hint").hidden = message.robots.length > 0;
  $("release").disabled = role !== "operator" || !message.is_stopped;
  document.body.dataset.stopped = String(message.is_stopped);
  document.body.dataset.places = message.robots.map((one) =>
    [one.id, one.x_m.toFixed(4), one.y_m.toFixed(4), one.speed_mps.toFixed(3)].join(" ")).join(";");
  if (message.is_stopped) notice(`All robots are stopped: ${message.why}`, true);
  else if ($("notice").dataset.isStop) notice("");
  showSelected();
}

function showPicture(message) {
  camera.take(message);
  $("camera-hint").textContent = `${message.markers.length} markers found`;
}

function showHealth(one) {
  if (recording !== one.recording) showRecordings();
  recording = one.recording;
  $("record").textContent = recording ? "End recording" : "Record";
  $("record").setAttribute("aria-pressed", String(Boolean(recording)));
  const parts = [one.scenario, `${one.image_rate_hz.toFixed(0)} images/s`,
    `${(1000 * one.turn_s).toFixed(0)} ms each`, `${one.picture_rate_hz.toFixed(0)} pictures/s`,
    one.picture_age_s === null ? "no picture yet" : `newest ${(1000 * one.picture_age_s).toFixed(0)} ms`,
    `${one.viewers} ${one.viewers === 1 ? "page" : "pages"}`];
  if (one.late_s > 0.1) parts.push(`this computer is too slow: ${one.late_s.toFixed(2)} s late`);
  if (recording) parts.push(`recording ${recording}`);
  $("health").textContent = parts.join(" · ");
  if (one.notice) notice(one.notice);
}

async function showRecordings() {
  if (role !== "operator") return;
  const answer = await fetch("/recordings");
  const found = answer.ok ? await answer.json() : [];
  $("shelf-hint").hidden = found.length > 0;
  $("recordings").replaceChildren(...found.map((one) => {
    const line = document.createElement("li"), link = document.createElement("a");
    link.href = `/recordings/${encodeURIComponent(one.name)}`;
    link.download = one.name;
    link.textContent = `${one.name}, ${(one.size_bytes / 1e6).toFixed(1)} MB`;
    line.append(link);
    return line;
  }));
}

function notice(text, isStop = false) {
  $("notice").textContent = text;
  $("notice").hidden = !text;
  $("notice").dataset.isStop = isStop ? "yes" : "";
}

function select(id) {
  selected = selected === id ? null : id;
  map.selected = selected;
  showSelected();
}

function showSelected() {
  const one = world?.robots.find((robot) => robot.id === selected);
  $("map").classList.toggle("armed", Boolean(one) && role === "operator");
  $("resume").disabled = role !== "operator" || !one?.goal_m;
  $("selected").textContent = one ? told(one)
    : "Select a robot on the map or in the table; then click where it shall go.";
}

function told(one) {
  const wheels = one.odometry
    ? `; its wheels say ${one.odometry.map((v) => v.toFixed(3)).join(", ")}` : "";
  const where = `${one.x_m.toFixed(3)}, ${one.y_m.toFixed(3)} m`;
  return `${one.name} at ${where}, ${one.neighbours.length} neighbours${wheels}. ` +
    (role === "operator" ? "Click on the map where it shall go." : "");
}

$("shelf").addEventListener("toggle", showRecordings);
$("stop").addEventListener("click", () => link.send("Stop"));
$("release").addEventListener("click", () => link.send("Release"));
$("resume").addEventListener("click", () => link.send("Resume", { robot_id: selected }));
$("record").addEventListener("click", () => link.send(recording ? "StopRecording" : "StartRecording"));
$("scenario-form").addEventListener("submit", (event) => {
  event.preventDefault();
  link.send("ChooseScenario", { name: $("scenario").value, robots: Number($("robots").value) });
});
$("sign-in").addEventListener("submit", async (event) => {
  event.preventDefault();
  const answer = await fetch("/sign-in", { method: "POST", body: $("token").value });
  $("token").value = "";
  $("sign-in-answer").textContent = answer.ok ? "" : await answer.text();
  if (answer.ok) link.reopen();
});
addEventListener("keydown", (event) => {
  if (event.code === "Escape") select(null);
  if (event.code !== "Space" || event.repeat || isTyping(event.target)) return;
  event.preventDefault(); // the space bar stops, whatever button has the focus
  link.send("Stop");
});
addEventListener("keyup", (event) => {
  if (event.code === "Space" && !isTyping(event.target)) event.preventDefault();
});

function isTyping(element) {
  return element instanceof HTMLInputElement || element instanceof HTMLTextAreaElement;
}
