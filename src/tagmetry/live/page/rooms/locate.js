// Locate: a camera's way on the map of markers, how sure it is, and what every marker says.
import { drawRoom } from "../locate/map.js";
import { make } from "../make.js";

const $ = (id) => document.getElementById(id);
const EMPTY = "No camera is being carried. Press the button: a simulated one goes round a room " +
  "with markers on its walls, and says from them where it is.";

export class LocateRoom {
  constructor(page) {
    this.id = "locate";
    this.page = page;
    this.trace = null;
    $("locate-form").addEventListener("submit", (event) => {
      event.preventDefault();
      page.send("StartLocate", { noise_px: Number($("locate-noise").value) });
    });
    $("locate-images-form").addEventListener("submit", (event) => {
      event.preventDefault();
      const [map_name, camera, images] = ["map-name", "camera", "images"].map((id) => $(`locate-${id}`).value);
      page.send("LocateImages", { map_name, camera, images });
    });
    $("locate-stop").addEventListener("click", () => page.send("StopLocate"));
    new ResizeObserver(() => drawRoom($("locate-map"), this.trace)).observe($("locate-map"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () =>
      drawRoom($("locate-map"), this.trace));
  }

  open() {}
  close() {}
  lost() {}

  welcome() {
    this.trace = null;
    this.show();
  }

  take(message) {
    if (message.type !== "LocateTrace") return;
    this.trace = message;
    this.show();
  }

  show() {
    const { trace } = this, last = trace?.path.at(-1);
    $("locate-say").textContent = said(trace);
    for (const id of ["locate-begin", "locate-open"]) {
      $(id).disabled = !this.page.commands || Boolean(trace?.is_running);
    }
    $("locate-stop").disabled = !this.page.commands || !trace?.is_running;
    $("locate-now").replaceChildren(...(last ? ["x", "y", "z"].map((axis, n) => axisLine(last, axis, n)) : []));
    $("locate-residuals").replaceChildren(...(trace?.residuals ?? []).map(residualLine));
    $("locate-trust").textContent = last ? trusted(trace.path) : "";
    drawRoom($("locate-map"), trace);
  }
}

function said(trace) {
  if (!trace) return EMPTY;
  const images = `${trace.path.length} places found`;
  const why = trace.why ? `; ${trace.why}` : "";
  return trace.is_running ? `Carried: ${images}${why}.` : `Put down: ${images}${why}.`;
}

function trusted(path) {
  if (path.at(-1).mahalanobis2 === null) return "Where it truly was nobody knows.";
  const mean = path.reduce((sum, one) => sum + one.mahalanobis2, 0) / path.length;
  return `Squared errors by their covariances are ${mean.toFixed(1)} on average over ${path.length} ` +
    "images; six numbers that are as sure as they say give 6.";
}

function axisLine(last, axis, n) {
  const place = last[`${axis}_m`];
  const off = last.true_m === null ? "–" : (1000 * (place - last.true_m[n])).toFixed(2);
  const cells = [place.toFixed(4), (1000 * last.sd_m[n]).toFixed(2), off,
    ((180 / Math.PI) * last.sd_rad[n]).toFixed(3)];
  return make("tr", {}, make("th", { scope: "row" }, axis), ...cells.map((text) => make("td", {}, text)));
}

function residualLine(one) {
  const cells = [one.distance_m.toFixed(2), one.rms_px.toFixed(3), one.is_used ? "yes" : one.why || "no"];
  return make("tr", {}, make("th", { scope: "row" }, String(one.id)),
    ...cells.map((text) => make("td", {}, text)));
}
