/* A robot of the simulated arena: clock, encoders and wheels over standard input and output.
 *
 * The link stays as it is; only these two calls take the place of the robot's own hardware.
 */
#ifndef TAGMETRY_TWIN_H
#define TAGMETRY_TWIN_H

/* Wait for the next tick: 1, or 0 at the end. Counts of the left and right wheel's encoder since
 * the start; tm_now_us() stands at this tick's time until the next. */
int tm_twin_tick(long long counts[2]);

/* Answer it, once: how fast the left and right wheel shall turn, rad/s. */
void tm_twin_drive(double left_radps, double right_radps);

#endif
