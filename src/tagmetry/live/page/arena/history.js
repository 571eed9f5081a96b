// @ts-check
// The newest minute of every robot, five times a second.
import { SPAN_S } from "./chart.js";

/** @typedef {import("../messages").LiveRobot} LiveRobot */
const STEP_S = 0.2;

export class History {
  constructor() {
    /** @type {Map<number, { times: number[], rows: (number | null)[][] }>} */
    this.robots = new Map();
    this.taken = -Infinity;
  }

  clear() { this.robots.clear(); this.taken = -Infinity; }

  /**
   * @param {import("../messages").World} world
   * @param {import("./ghosts.js").Ghosts} ghosts
   * @returns {boolean} whether it was time for a new line
   */
  take(world, ghosts) {
    if (world.time_s - this.taken < STEP_S) return false;
    this.taken = world.time_s;
    for (const one of world.robots) {
      const own = this.robots.get(one.id) ?? { times: [], rows: [] };
      own.times.push(world.time_s);
      own.rows.push(numbers(one, world.robots, ghosts));
      while (world.time_s - own.times[0] > SPAN_S) { own.times.shift(); own.rows.shift(); }
      this.robots.set(one.id, own);
    }
    return true;
  }

  /** @param {number} id @param {number[]} columns */
  lines(id, columns) {
    const own = this.robots.get(id) ?? { times: [], rows: [] };
    return { times: own.times, lines: columns.map((n) => own.rows.map((row) => row[n])) };
  }
}

// speed, left and right wheel, gap to the nearest robot, wheels off the camera, round trip, battery
function numbers(one, robots, ghosts) {
  const off = ghosts.off(one), wheels = one.wheels_radps ?? [null, null];
  return [one.speed_mps, ...wheels, gap(one, robots), off && 1000 * off.off_m,
    one.round_trip_s && 1000 * one.round_trip_s, one.battery_v];
}

// Between rims, to the nearest robot.
function gap(one, robots) {
  const gaps = robots.filter((other) => other.id !== one.id).map((other) =>
    Math.hypot(other.x_m - one.x_m, other.y_m - one.y_m) - other.radius_m - one.radius_m);
  return gaps.length ? Math.min(...gaps) : null;
}
