/* As much of the ESP32's Arduino interface as the documented sketch uses; does nothing. */
#pragma once
#include <cstddef>
#include <cstdint>

struct IPAddress {
    IPAddress(int, int, int, int) {}
};
struct Station {
    void begin(const char *, const char *) {}
    void setSleep(bool) {}
};
static Station WiFi;
inline uint32_t esp_random() { return 4; }
inline int64_t esp_timer_get_time() { return 0; }
inline void delay(int) {}
