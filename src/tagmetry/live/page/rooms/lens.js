// The lens: a marker is looked for, measured, followed; what zoom and focus do meanwhile.
import { drawSeries } from "../lens/charts.js";
import { make } from "../make.js";

const $ = (id) => document.getElementById(id);
const EMPTY = "The lens rests. Press the button, and zoom and focus are driven until a marker of " +
  "10 mm is measured.";
const AGAIN_MS = 1000; // while the bank is being solved
const PHASES = { preparing: "Preparing", scan: "Looking through zoom and focus",
  iterate: "Coming closer", average: "Measuring", track: "Following", reacquire: "Lost: looking again",
  ended: "Ended" };

export class LensRoom {
  constructor(page) {
    this.id = "lens";
    this.page = page;
    this.trace = this.bank = null;
    this.newest = 0;
    $("lens-form").addEventListener("submit", (event) => {
      event.preventDefault();
      page.send("StartLens", { depth_m: Number($("lens-depth").value),
        turn_deg: Number($("lens-turn").value), tracks: $("lens-tracks").value === "yes" });
    });
    $("lens-stop").addEventListener("click", () => page.send("StopLens"));
    new ResizeObserver(() => this.draw()).observe($("lens-depths"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  open() {
    this.isOpen = true;
    this.loadBank();
  }

  close() { this.isOpen = false; }
  lost() {}

  welcome() {
    this.trace = null;
    this.show();
    if (this.isOpen) this.loadBank();
  }

  async take(message) {
    if (message.type === "LensPicture" && this.isOpen) await this.showPicture(message);
    if (message.type !== "LensTrace") return;
    this.trace = message;
    this.show();
  }

  show() {
    const { trace } = this, isBusy = trace !== null && trace.phase !== "ended";
    $("lens-say").textContent = said(trace);
    $("lens-begin").disabled = !this.page.commands || isBusy;
    $("lens-stop").disabled = !this.page.commands || !isBusy;
    this.draw();
  }

  async showPicture(picture) {
    const number = ++this.newest, image = await createImageBitmap(picture.jpeg);
    if (number === this.newest) drawPicture($("lens-picture"), image, picture);
    image.close();
  }

  draw() {
    const points = this.trace?.points ?? [], x = points.map((one) => one.time_s);
    const of = (get, more) => ({ x, y: points.map(get), color: "--accent", ...more });
    const sd = points.map((one) => one.depth_sd_m);
    drawSeries($("lens-depths"), [of((one) => one.true_m, { color: "--soft", dashed: true }),
      of((one) => one.depth_m, { sd })], "m");
    drawSeries($("lens-errors"), [of((one) => off_mm(one), { sd: sd.map((one) => one && 1000 * one) })], "mm");
    drawSeries($("lens-zooms"), [of((one) => one.zoom_percent)], "%");
    drawSeries($("lens-focuses"), [of((one) => one.focus)], "");
    this.drawBank();
  }

  async loadBank() {
    if (this.bank) return;
    const answer = await fetch("/lens/bank");
    if (answer.status === 409 && this.isOpen) return setTimeout(() => this.loadBank(), AGAIN_MS);
    if (!answer.ok) return;
    this.bank = await answer.json();
    $("lens-bank-hint").textContent = "Depth that is sharp (across, 0.05 to 1.1 m, in equal ratios) " +
      "at each focus (up), and the camera as it was solved there.";
    $("lens-bank").replaceChildren(...this.bank.nodes.map(nodeLine));
    this.drawBank();
  }

  drawBank() {
    const curve = this.bank?.curve ?? [];
    drawSeries($("lens-curve"), [{ x: curve.map((one) => one[0]), y: curve.map((one) => one[1]),
      color: "--accent" }], "", { log: true });
  }
}

function off_mm(one) { return one.depth_m === null ? null : 1000 * (one.depth_m - one.true_m); }

function said(trace) {
  if (!trace) return EMPTY;
  const last = trace.points.findLast((one) => one.depth_m !== null);
  const depth = last ? ` ${(1000 * last.depth_m).toFixed(2)} ± ${(1000 * last.depth_sd_m).toFixed(2)} mm` : "";
  const done = trace.converged_s === null ? "" : `, measured after ${trace.converged_s.toFixed(2)} s`;
  return `${PHASES[trace.phase]}: image ${trace.images}${depth && ","}${depth}${done}${trace.why ? `; ${trace.why}` : ""}.`;
}

function drawPicture(canvas, image, picture) {
  canvas.width = picture.width_px;
  canvas.height = picture.height_px;
  const pen = canvas.getContext("2d");
  pen.drawImage(image, 0, 0);
  pen.translate(0.5, 0.5); // an integer pixel is a pixel's centre
  pen.strokeStyle = "#00c2ff";
  pen.lineWidth = 2;
  pen.beginPath();
  for (const [x, y] of picture.corners_px) pen.lineTo(x, y);
  pen.closePath();
  pen.stroke();
  canvas.dataset.corners = picture.corners_px.length;
}

function nodeLine(one) {
  const cells = [one.fx_px.toFixed(2), one.fx_sd_px?.toFixed(2) ?? "–", one.cx_px.toFixed(2),
    one.cy_px.toFixed(2), one.k1.toFixed(5)];
  return make("tr", {}, make("th", { scope: "row" }, one.focus.toFixed(0)),
    ...cells.map((text) => make("td", {}, text)));
}
