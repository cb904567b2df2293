
/* Adds bits to a hash: FNV-1a (Fowler, Noll, Vo; 32 bit). */
static uint32_t prefix_hashed(uint32_t hash, uint32_t bits)
{
    uint32_t hashed = hash;
    unsigned shift;

    for (shift = 0U; shift < 32U; shift += 8U) {
        hashed = (hashed ^ ((bits >> shift) & 0xffU)) * 0x01000193U;
    }
    return hashed;
}

/* Arcs of a parabola to alternate sides, an actuator that is late, and at the end of each 512 ticks a fault. */
uint32_t prefix_digest(void)
{
    const float step_s = 0x1p-10f;
    uint32_t hash = 0x811c9dc5U;
    uint32_t random = 1U;
    uint32_t tick;
    float reached_m = 0.0f;
    float change_m = 0.0f;
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
    for (tick = 0U; tick < 2048U; tick++) {
        const uint32_t in_arc = tick % 128U;
        const float part = (float)in_arc * 0x1p-7f;
        const float arc = 0x1p-6f * part * (1.0f - part);
        const uint32_t part_of_test = tick / 512U;
        const uint32_t fault = ((tick % 512U) >= 384U) ? part_of_test : 4U;
        const bool is_other_side = ((tick / 128U) % 2U) != 0U;
        const prefix_motion motion = prefix_motion_filter_push(&filter, is_other_side ? -arc : arc);
        prefix_measured measured;
        prefix_command command;

        random = (random * 1664525U) + 1013904223U;
        const uint32_t upper = random >> 8U;
        const float noise = ((float)upper * 0x1p-24f) - 0.5f; /* the product is exact */
        measured.displacement_m = reached_m + prefix_product(0x1p-19f, noise);
        measured.force_n = prefix_product(0x1p24f, change_m) + prefix_product(16.0f, noise);
        if (fault == 1U) {
            measured.displacement_m = prefix_real_of(0x7fc00000U);
        }
        if (fault == 2U) {
            measured.force_n = -measured.force_n;
        }
        if (tick == ((3U * 512U) + 384U)) {
            prefix_end(&system);
        }
        command = prefix_tick(&system, &motion, (fault == 0U) ? NULL : &measured);
        change_m = prefix_product(0.125f, command.command_m - reached_m);
        reached_m = reached_m + change_m;
        hash = prefix_hashed(hash, prefix_bits_of(command.command_m));
        hash = prefix_hashed(hash, prefix_bits_of(command.force_n));
        hash = prefix_hashed(hash, command.status);
        if ((tick % 512U) == 383U) {
            const prefix_reading reading = prefix_read(&system);

            hash = prefix_hashed(hash, prefix_bits_of(reading.delay_s));
            hash = prefix_hashed(hash, prefix_bits_of(reading.amplitude));
            hash = prefix_hashed(hash, prefix_bits_of(reading.relative_error));
            hash = prefix_hashed(hash, prefix_bits_of(reading.added_share));
            for (i = 0; i < 4; i++) {
                hash = prefix_hashed(hash, prefix_bits_of(reading.coefficients[i]));
            }
        }
        if ((tick % 512U) == 511U) {
            (void)prefix_clear(&system);
        }
    }
    return hash;
}

