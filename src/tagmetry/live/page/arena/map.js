// @ts-check
// The arena from above: trails, robots with headings, covariance ellipses, neighbour links.
import { drawErrors, drawGhost, drawPlan, drawReach, drawStage } from "./layers.js";
import { prepared } from "../canvas.js";

const TRAIL = 150;
const ELLIPSE_TIMES = 1000; // a standard deviation is too small to be seen

export class ArenaMap {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {(x: number, y: number, robot: number | null, isShifted: boolean) => void} onClick
   */
  constructor(canvas, onClick) {
    this.canvas = canvas;
    this.half = [1.6, 0.85];
    this.trails = new Map();
    this.robots = [];
    this.selected = null;
    this.stage = this.errors = this.ghosts = null; // messages, and where wheels say that robots are
    this.plan = [];
    canvas.addEventListener("click", (event) => {
      const box = canvas.getBoundingClientRect();
      const [x, y] = this.place(event.clientX - box.left, event.clientY - box.top);
      onClick(x, y, this.hit(event, box), event.shiftKey);
    });
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /** @param {import("../messages").World} world */
  take(world) {
    this.robots = world.robots;
    for (const one of world.robots) {
      const trail = this.trails.get(one.id) ?? [];
      trail.push([one.x_m, one.y_m]);
      if (trail.length > TRAIL) trail.shift();
      this.trails.set(one.id, trail);
    }
    this.draw();
  }

  clear() { this.trails.clear(); this.robots = []; this.draw(); }

  scale() {
    const { clientWidth: w, clientHeight: h } = this.canvas;
    return Math.min(w / (2 * this.half[0] + 0.3), h / (2 * this.half[1] + 0.3));
  }

  place(px, py) {
    const k = this.scale();
    return [(px - this.canvas.clientWidth / 2) / k, (this.canvas.clientHeight / 2 - py) / k];
  }

  hit(event, box) {
    const [x, y] = this.place(event.clientX - box.left, event.clientY - box.top);
    const near = this.robots.find((one) => Math.hypot(one.x_m - x, one.y_m - y) <= one.radius_m);
    return near ? near.id : null;
  }

  draw() {
    const { pen, width: w, height: h, color } = prepared(this.canvas), k = this.scale();
    pen.translate(w / 2, h / 2);
    /** @type {(x: number, y: number) => [number, number]} */
    const at = (x, y) => [x * k, -y * k];
    pen.strokeStyle = color("--line");
    pen.strokeRect(-this.half[0] * k, -this.half[1] * k, 2 * this.half[0] * k, 2 * this.half[1] * k);
    const view = { pen, at, color, k };
    if (this.errors) drawErrors(view, this.errors);
    if (this.stage) drawStage(view, this.stage);
    this.drawBar(pen, color, k, w, h);
    this.drawTrails(pen, at);
    this.drawLinks(pen, at, color);
    this.drawSelected(view);
    drawPlan(view, this.plan);
    for (const one of this.robots) this.drawRobot(pen, at, color, k, one);
  }

  drawSelected(view) {
    const one = this.robots.find((robot) => robot.id === this.selected);
    if (!one) return;
    if (this.stage) drawReach(view, one, this.stage.reach_m);
    const ghost = this.ghosts?.known.get(one.id);
    if (ghost) drawGhost(view, ghost, one.radius_m);
  }

  drawBar(pen, color, k, w, h) {
    pen.fillStyle = pen.strokeStyle = color("--soft");
    pen.font = "12px system-ui, sans-serif";
    pen.fillText(`0.5 m · ellipses ${ELLIPSE_TIMES} ×`, 10 - w / 2, h / 2 - 14);
    pen.fillRect(10 - w / 2, h / 2 - 9, 0.5 * k, 2);
  }

  drawTrails(pen, at) {
    for (const [id, trail] of this.trails) {
      pen.strokeStyle = hue(id, 0.45);
      pen.lineWidth = 1.5;
      pen.beginPath();
      for (const [x, y] of trail) pen.lineTo(...at(x, y));
      pen.stroke();
    }
  }

  drawLinks(pen, at, color) {
    const byId = new Map(this.robots.map((one) => [one.id, one]));
    pen.strokeStyle = color("--line");
    pen.lineWidth = 1;
    for (const one of this.robots) {
      const isSelected = one.id === this.selected;
      if (this.selected !== null && !isSelected) continue;
      pen.strokeStyle = color(isSelected ? "--accent" : "--line");
      for (const id of one.neighbours) {
        const other = byId.get(id);
        if (!other || (this.selected === null && other.id < one.id)) continue;
        pen.beginPath();
        pen.moveTo(...at(one.x_m, one.y_m));
        pen.lineTo(...at(other.x_m, other.y_m));
        pen.stroke();
      }
    }
  }

  drawRobot(pen, at, color, k, one) {
    const [x, y] = at(one.x_m, one.y_m), r = one.radius_m * k;
    pen.lineWidth = one.id === this.selected ? 3 : 1.5;
    pen.fillStyle = hue(one.id, one.is_seen ? 0.35 : 0.1);
    pen.strokeStyle = one.is_stopped ? color("--bad") : hue(one.id, 1);
    if (one.id === this.selected) pen.strokeStyle = color("--accent");
    pen.setLineDash(one.is_seen ? [] : [4, 3]);
    pen.beginPath();
    pen.arc(x, y, r, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
    pen.setLineDash([]);
    pen.beginPath();
    pen.moveTo(x, y);
    pen.lineTo(x + 1.3 * r * Math.cos(one.heading_rad), y - 1.3 * r * Math.sin(one.heading_rad));
    pen.stroke();
    this.drawEllipse(pen, color, k, one, x, y);
    this.drawGoal(pen, at, color, one, x, y);
    pen.fillStyle = color("--ink");
    pen.textAlign = "center";
    pen.fillText(String(one.id), x, y + r + 13);
    pen.textAlign = "start";
  }

  drawEllipse(pen, color, k, one, x, y) {
    const [long, short, turn] = one.ellipse;
    if (long === null || short === null) return;
    pen.strokeStyle = color("--ink");
    pen.lineWidth = 1;
    pen.beginPath();
    pen.ellipse(x, y, ELLIPSE_TIMES * long * k, ELLIPSE_TIMES * short * k, -turn, 0, 2 * Math.PI);
    pen.stroke();
  }

  drawGoal(pen, at, color, one, x, y) {
    if (!one.path_m.length) return;
    pen.strokeStyle = color("--accent");
    pen.setLineDash([3, 4]);
    pen.beginPath();
    if (one.task === "visit") pen.moveTo(x, y);
    for (const point of one.path_m) pen.lineTo(...at(...point));
    pen.stroke();
    pen.setLineDash([]);
    const [gx, gy] = at(...one.path_m.at(-1));
    pen.strokeRect(gx - 4, gy - 4, 8, 8);
  }
}

export function hue(id, alpha) {
  return `hsl(${(id * 137.5) % 360} 65% 50% / ${alpha})`;
}
