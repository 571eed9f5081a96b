#include "tagmetry_twin.h"

#include <stdio.h>

#include "tagmetry_posix.h"

int tm_twin_tick(long long counts[2]) {
    long long now_us;
    if (scanf("%lld %lld %lld", &now_us, &counts[0], &counts[1]) != 3) return 0;
    tm_hold_clock((uint64_t)now_us);
    return 1;
}

void tm_twin_drive(double left_radps, double right_radps) {
    printf("%.17g %.17g\n", left_radps, right_radps);
    fflush(stdout);
}
