// What the driven lens does over time, and the curve that it is driven along.
import { prepared } from "../canvas.js";

const LEFT = 76, EDGE = 8;

// Draws series of {x, y, sd, color, dashed}; y may be null where nothing was measured.
export function drawSeries(canvas, series, unit, { log = false } = {}) {
  const { pen, width, height, color } = prepared(canvas);
  const xs = series.flatMap((one) => one.x), ys = series.flatMap((one) => ends(one));
  if (!xs.length || !ys.length) return;
  const across = scale(xs, LEFT, width - EDGE, log), up = scale(padded(ys), height - EDGE, EDGE);
  pen.fillStyle = color("--soft");
  pen.textBaseline = "middle";
  for (const y of [Math.min(...ys), Math.max(...ys)]) pen.fillText(`${y.toPrecision(3)} ${unit}`, 2, up(y));
  for (const one of series) drawOne(pen, one, across, up, color(one.color));
}

function drawOne(pen, one, across, up, color) {
  pen.strokeStyle = pen.fillStyle = color;
  pen.lineWidth = 1.5;
  pen.setLineDash(one.dashed ? [5, 4] : []);
  pen.beginPath();
  let isBroken = true;
  one.x.forEach((x, n) => {
    if (one.y[n] === null) { isBroken = true; return; }
    if (isBroken) pen.moveTo(across(x), up(one.y[n]));
    else pen.lineTo(across(x), up(one.y[n]));
    isBroken = false;
  });
  pen.stroke();
  pen.setLineDash([]);
  one.sd?.forEach((sd, n) => {
    if (sd === null || one.y[n] === null) return;
    const x = across(one.x[n]), top = up(one.y[n] + 2 * sd), low = up(one.y[n] - 2 * sd);
    pen.globalAlpha = 0.35;
    pen.fillRect(x - 1.5, top, 3, Math.max(low - top, 1));
    pen.globalAlpha = 1;
    pen.fillRect(x - 1.5, up(one.y[n]) - 1.5, 3, 3);
  });
}

function ends(one) {
  return one.y.flatMap((y, n) => y === null ? []
    : one.sd?.[n] ? [y - 2 * one.sd[n], y + 2 * one.sd[n]] : [y]);
}

function padded(values) {
  const low = Math.min(...values), high = Math.max(...values);
  const more = 0.08 * (high - low) || Math.abs(high) * 0.02 || 1;
  return [low - more, high + more];
}

function scale(values, from, to, log = false) {
  const of = log ? Math.log : (value) => value;
  const low = of(Math.min(...values)), high = of(Math.max(...values)), span = high - low || 1;
  return (value) => from + (to - from) * (of(value) - low) / span;
}
