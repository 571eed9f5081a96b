/* A robot of a swarm that steers itself: away from all that are near, by its neighbours alone.
 * In the simulated arena; on a real robot, your own encoders and motors take the place of
 * tm_twin_tick and tm_twin_drive.
 */
#include <math.h>
#include <stdlib.h>

#include "tagmetry_posix.h"
#include "tagmetry_twin.h"

static const double WHEEL_RADIUS_M = 0.033, TRACK_M = 0.130, PI = 3.141592653589793;
static const int COUNTS_PER_TURN = 1440;

typedef struct { double forward_mps, turn_radps; } twist;

static double within(double value, double limit) { return fmax(-limit, fmin(value, limit)); }

static twist controller(const tm_robot *robot) {
    double x_m = 0, y_m = 0;
    for (int i = 0; i < robot->neighbours.count; i++) {
        double bearing_rad = robot->seen[i].bearing * 1e-4;
        double push_m = fmax(0.8 - robot->seen[i].range_mm / 1000.0, 0.0);
        x_m -= push_m * cos(bearing_rad);
        y_m -= push_m * sin(bearing_rad);
    }
    twist still = {0, 0}, away;
    double wish_mps = fmin(1.5 * hypot(x_m, y_m), 0.15), bearing_rad = atan2(y_m, x_m);
    if (wish_mps < 0.005) return still;
    away.forward_mps = wish_mps * fmax(cos(bearing_rad), 0.0);
    away.turn_radps = within(4 * bearing_rad, 3.0);
    return away;
}

static void tell(tm_robot *robot, int host, const long long counts[2]) {
    static long long before[2];
    static uint64_t next_us;
    static tm_odometry wheels; /* where the wheels say it is, from where it was switched on */
    uint64_t now_us = tm_now_us();
    if (now_us < next_us) return;
    double m_per_count = 2 * PI * WHEEL_RADIUS_M / COUNTS_PER_TURN;
    double left_m = m_per_count * (double)(counts[0] - before[0]);
    double right_m = m_per_count * (double)(counts[1] - before[1]);
    double heading_rad = wheels.heading_rad + (right_m - left_m) / TRACK_M / 2;
    double step_s = next_us ? (double)(now_us + 20000 - next_us) / 1e6 : 1;
    wheels.measured_us = robot->is_linked ? tm_host_us(robot, now_us) : 0;
    wheels.x_m += (float)((left_m + right_m) / 2 * cos(heading_rad));
    wheels.y_m += (float)((left_m + right_m) / 2 * sin(heading_rad));
    heading_rad = wheels.heading_rad + (right_m - left_m) / TRACK_M;
    wheels.heading_rad = (float)remainder(heading_rad, 2 * PI);
    wheels.forward_mps = (float)((left_m + right_m) / 2 / step_s);
    wheels.turn_radps = (float)((right_m - left_m) / TRACK_M / step_s);
    before[0] = counts[0], before[1] = counts[1], next_us = now_us + 20000;
    tm_send(robot, host, TM_ODOMETRY, &wheels, sizeof wheels);
}

int main(int count, char **words) { /* spread ADDRESS PORT ROBOT KEY */
    uint8_t key[TM_KEY_BYTES] = {0};
    int host = count == 5 ? tm_connect(words[1], (uint16_t)atoi(words[2])) : -1;
    if (host < 0 || !tm_parse_key(key, words[4])) return 2;
    tm_robot robot;
    tm_begin(&robot, (uint16_t)atoi(words[3]), key);
    for (long long counts[2]; tm_twin_tick(counts);) {
        tm_step(&robot, host, 0);
        tell(&robot, host, counts);
        twist wanted = {0, 0};
        if (tm_may_move(&robot, tm_now_us())) wanted = controller(&robot);
        double aside_mps = wanted.turn_radps * TRACK_M / 2;
        tm_twin_drive((wanted.forward_mps - aside_mps) / WHEEL_RADIUS_M,
                      (wanted.forward_mps + aside_mps) / WHEEL_RADIUS_M);
    }
    return 0;
}
