
/* Adds bits to a hash: FNV-1a (Fowler, Noll, Vo; 32 bit). */
static uint32_t prefix_hashed(uint32_t hash, uint32_t bits)
{
    int shift;

    for (shift = 0; shift < 32; shift += 8) {
        hash = (hash ^ (bits >> shift & 0xffU)) * UINT32_C(0x01000193);
    }
    return hash;
}

/* Arcs of a parabola to alternate sides, an actuator that is late, and at the end of each 512 ticks a fault. */
uint32_t prefix_digest(void)
{
    const float step_s = 0x1p-10f;
    uint32_t hash = UINT32_C(0x811c9dc5), random = 1, tick;
    float reached_m = 0.0f, change_m = 0.0f;
    prefix_settings settings;
    prefix_motion_filter filter;
    prefix_system system;
    int i;

    prefix_default_settings(&settings, 0.05f, 0.5f, 20e3f);
    prefix_set_delay(&settings, 0.0078125f, 0.00390625f);
    settings.action = PREFIX_ZERO_FORCE;
    settings.approach_m_per_s = 0.25f;
    settings.energy_window_s = 0.25f;
    settings.ramp_s = 0.0625f;
    (void)prefix_motion_filter_init(&filter, 40.0f, step_s);
    (void)prefix_init(&system, &settings, step_s);
    for (tick = 0; tick < 2048; tick++) {
        const float part = (float)(tick % 128) * 0x1p-7f;
        const float arc = 0x1p-6f * part * (1.0f - part);
        const uint32_t fault = tick % 512 >= 384 ? tick / 512 : 4;
        const prefix_motion motion = prefix_motion_filter_push(&filter, tick / 128 % 2 == 0 ? arc : -arc);
        prefix_measured measured;
        prefix_command command;
        float noise;

        random = random * UINT32_C(1664525) + UINT32_C(1013904223);
        noise = (float)(random >> 8) * 0x1p-24f - 0.5f; /* the product is exact */
        measured.displacement_m = reached_m + prefix_product(0x1p-19f, noise);
        measured.force_n = prefix_product(0x1p24f, change_m) + prefix_product(16.0f, noise);
        if (fault == 1) {
            measured.displacement_m = prefix_real_of(0x7fc00000U);
        } else if (fault == 2) {
            measured.force_n = -measured.force_n;
        }
        if (tick == 3 * 512 + 384) {
            prefix_end(&system);
        }
        command = prefix_tick(&system, &motion, fault == 0 ? NULL : &measured);
        change_m = prefix_product(0.125f, command.command_m - reached_m);
        reached_m = reached_m + change_m;
        hash = prefix_hashed(hash, prefix_bits_of(command.command_m));
        hash = prefix_hashed(hash, prefix_bits_of(command.force_n));
        hash = prefix_hashed(hash, command.status);
        if (tick % 512 == 383) {
            const prefix_reading reading = prefix_read(&system);

            hash = prefix_hashed(hash, prefix_bits_of(reading.delay_s));
            hash = prefix_hashed(hash, prefix_bits_of(reading.amplitude));
            hash = prefix_hashed(hash, prefix_bits_of(reading.relative_error));
            hash = prefix_hashed(hash, prefix_bits_of(reading.added_share));
            for (i = 0; i < 4; i++) {
                hash = prefix_hashed(hash, prefix_bits_of(reading.coefficients[i]));
            }
        }
        if (tick % 512 == 511) {
            (void)prefix_clear(&system);
        }
    }
    return hash;
}

