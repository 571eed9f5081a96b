// Calibration: the live picture with the outline to be matched, how far it is, and the camera.
import { CalibrationView } from "../calibrate/view.js";
import { drawCoverage, drawUncertainty } from "../calibrate/charts.js";
import { make } from "../make.js";

const $ = (id) => document.getElementById(id);
const EMPTY = "Nothing is being calibrated. Print a board in the room Print, or keep the one that " +
  "the simulated camera is shown, and press Begin.";

export class CalibrateRoom {
  constructor(page) {
    this.id = "calibrate";
    this.page = page;
    this.view = new CalibrationView($("calibrate-picture"));
    this.state = null;
    $("calibrate-form").addEventListener("submit", (event) => {
      event.preventDefault();
      page.send("StartCalibration", { board: $("calibrate-board").value.trim(),
        uncertainty: $("calibrate-wanted").value.trim() });
    });
    $("calibrate-end").addEventListener("click", () => page.send("EndCalibration"));
    $("calibrate-save").addEventListener("submit", (event) => {
      event.preventDefault();
      page.send("SaveCalibration", { name: $("calibrate-name").value.trim() });
    });
    new ResizeObserver(() => this.drawCharts()).observe($("calibrate-coverage"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.drawCharts());
  }

  open() { this.isOpen = true; }
  close() { this.isOpen = false; }
  lost() {}

  welcome() {
    this.state = null;
    this.view.clear();
    this.show();
  }

  async take(message) {
    if (message.type === "CalibrationPicture" && this.isOpen) await this.view.take(message);
    if (message.type !== "CalibrationState") return;
    this.state = message;
    this.show();
  }

  show() {
    const { state } = this, isBusy = ["looking", "solving"].includes(state?.phase);
    $("calibrate-advice").textContent = headline(state);
    $("calibrate-why").textContent = state?.why ?? "";
    $("calibrate-why").className = state?.phase === "failed" ? "bad" : "hint";
    $("calibrate-begin").disabled = !this.page.commands || isBusy;
    $("calibrate-end").disabled = !this.page.commands || state?.phase !== "looking";
    $("calibrate-far").textContent = far(state);
    this.drawCharts();
    this.showResult(state?.result ?? null);
  }

  drawCharts() {
    drawCoverage($("calibrate-coverage"), this.state?.coverage ?? []);
    drawUncertainty($("calibrate-uncertainty"), this.state?.uncertainty_px ?? [],
      this.state?.wanted_px ?? null);
  }

  showResult(result) {
    $("calibrate-result").hidden = !result;
    if (!result) return;
    $("calibrate-words").textContent = result.words;
    $("calibrate-numbers").replaceChildren(...result.numbers.map(numberLine));
    $("calibrate-errors").textContent = errors(result);
    $("calibrate-fit").replaceChildren(...result.fit_for.map((text) => make("li", {}, text)));
    $("calibrate-doubts").replaceChildren(...result.doubts.map((text) => make("li", {}, text)));
    $("calibrate-doubts-title").hidden = result.doubts.length === 0;
    $("calibrate-report").hidden = !result.has_report;
    $("calibrate-saved").textContent = this.state.saved
      ? `Saved as ${this.state.saved}.yaml in the server's folder of cameras.` : "";
  }
}

function headline(state) {
  if (!state) return EMPTY;
  if (state.phase === "failed") return "There is no camera:";
  if (state.phase === "done") return "The camera is solved.";
  return state.advice.charAt(0).toUpperCase() + state.advice.slice(1) + ".";
}

function far(state) {
  if (!state) return "";
  const views = state.uncertainty_px.length, now = state.uncertainty_px.at(-1);
  const told = `${state.camera}, ${state.board}: ${views} ${views === 1 ? "view" : "views"} taken`;
  return views && now !== null
    ? `${told}; uncertain by ${now.toFixed(2)} px at the worst place, ${state.wanted_px} px wanted.`
    : `${told}.`;
}

function errors(one) {
  const left = one.hold_out_px === null ? "" : `, of views left out ${one.hold_out_px.toFixed(3)} px`;
  return `${one.lens} lens. Error of the views ${one.rms_px.toFixed(3)} px${left}.`;
}

function numberLine(one) {
  const digits = one.sd > 0 ? Math.min(Math.max(1 - Math.floor(Math.log10(one.sd)), 0), 8) : 3;
  const cells = [one.value.toFixed(digits), one.sd === null ? "–" : one.sd.toPrecision(2)];
  return make("tr", {}, make("th", { scope: "row" }, one.name),
    ...cells.map((text) => make("td", {}, text)));
}
