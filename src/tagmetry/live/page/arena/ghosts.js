// @ts-check
// Where robots would be by their wheels alone, from where the camera saw them first.
/** @typedef {import("../messages").LiveRobot} LiveRobot */
/** @typedef {[number, number, number]} Place x, y, heading */
const TRAIL = 400;

export class Ghosts {
  constructor() {
    /** @type {Map<number, { frame: Place, place: Place, trail: [number, number][] }>} */
    this.known = new Map();
  }

  clear() { this.known.clear(); }

  /** @param {LiveRobot[]} robots */
  take(robots) {
    for (const one of robots) if (one.odometry && one.is_seen) this.follow(one, one.odometry);
  }

  /** @param {LiveRobot} one @param {Place} wheels */
  follow(one, wheels) {
    const own = this.known.get(one.id) ?? this.begin(one, wheels);
    own.place = joined(own.frame, wheels);
    own.trail.push([own.place[0], own.place[1]]);
    if (own.trail.length > TRAIL) own.trail.shift();
  }

  /** @param {LiveRobot} one @param {Place} wheels */
  begin(one, wheels) {
    const frame = joined([one.x_m, one.y_m, one.heading_rad], inverse(wheels));
    const own = { frame, place: wheels, trail: [] };
    this.known.set(one.id, own);
    return own;
  }

  /**
   * How far the wheels are off the camera.
   * @param {LiveRobot} one
   * @returns {{ off_m: number, turned_rad: number } | null}
   */
  off(one) {
    const own = this.known.get(one.id);
    if (!own) return null;
    const [x, y, heading] = own.place, turned = heading - one.heading_rad;
    return { off_m: Math.hypot(x - one.x_m, y - one.y_m),
      turned_rad: Math.atan2(Math.sin(turned), Math.cos(turned)) };
  }
}

/** @param {Place} a @param {Place} b @returns {Place} b, which a's frame tells, in a's outer frame */
export function joined([x, y, heading], [along, aside, turn]) {
  const c = Math.cos(heading), s = Math.sin(heading);
  return [x + c * along - s * aside, y + s * along + c * aside, heading + turn];
}

/** @param {Place} place @returns {Place} */
export function inverse([x, y, heading]) {
  const c = Math.cos(heading), s = Math.sin(heading);
  return [-c * x - s * y, s * x - c * y, -heading];
}
