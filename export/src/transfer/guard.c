
/* Number of ticks for which a condition has held without a break. */
PREFIX_INLINE uint32_t prefix_counted(bool holds, uint32_t so_far)
{
    return holds ? (so_far + ((so_far != UINT32_MAX) ? 1U : 0U)) : 0U;
}

static bool prefix_has_ended(const prefix_system *system)
{
    return (system->phase != PREFIX_APPROACHING) && (system->phase != PREFIX_RUNNING);
}

/* Plans the end: the velocity falls to zero evenly, and the way to the position without force has a smooth start and
 * end. The time is longer than stated if the way would need more than half the velocity limit. */
static void prefix_begin_to_end(prefix_system *system)
{
    const prefix_settings *const settings = &system->settings;

    system->release_m = 0.0f;
    if ((settings->action == PREFIX_ZERO_FORCE) && (system->age == 0U)) {
        system->release_m = prefix_clamped(-system->force_n / settings->stiffness_n_per_m, settings->stroke_m);
    }
    /* The smooth way has 1.5 times its mean velocity in the middle. */
    const float least_s = (3.0f * prefix_magnitude(system->release_m)) / settings->velocity_m_per_s;
    system->duration_s = (settings->ramp_s > least_s) ? settings->ramp_s : least_s;
    system->phase = PREFIX_ENDING;
    system->from_m = system->command_m;
    system->from_change_m = system->change_m;
    system->ending_s = 0.0f;
}

/* Change of the command (m) in a tick of the end. */
static float prefix_ending_change(prefix_system *system)
{
    system->ending_s = system->ending_s + system->step_s;
    const float part = system->ending_s / system->duration_s;
    const float share = (part < 1.0f) ? part : 1.0f;
    if (share == 1.0f) {
        system->phase = PREFIX_HELD;
    }
    const float run_out = prefix_product(system->from_change_m / system->step_s, system->duration_s);
    const float running_out = prefix_product(run_out * share, 1.0f - prefix_product(0.5f, share));
    const float releasing = prefix_product(system->release_m * share * share, 3.0f - prefix_product(2.0f, share));
    return ((system->from_m + running_out) + releasing) - system->command_m;
}

/* Takes the measured values; returns what is wrong with them. */
PREFIX_INLINE uint32_t prefix_measure(prefix_system *system, const prefix_measured *measured)
{
    const prefix_settings *const settings = &system->settings;
    const float since_s = prefix_product(system->step_s, (float)system->age + 1.0f);
    const float nothing = prefix_real_of(0x7fc00000U);
    const float infinity = prefix_real_of(0x7f800000U);
    const float displacement = (measured != NULL) ? measured->displacement_m : nothing;
    const float force = (measured != NULL) ? measured->force_n : nothing;
    /* The first measurement of all has nothing to be compared with. */
    const bool is_first = system->phase == PREFIX_APPROACHING;
    const float moved = prefix_magnitude(displacement - system->displacement_m);
    const float changed = prefix_magnitude(force - system->force_n);
    const bool is_plausible = (moved <= (settings->plausible_m_per_s * since_s))
                              && (changed <= (settings->plausible_n_per_s * since_s));
    uint32_t found = 0U;

    if (is_plausible || (is_first && (moved < infinity) && (changed < infinity))) {
        system->displacement_same_m = (moved > 0.0f) ? 0.0f : system->displacement_same_m;
        system->force_same_m = (changed > 0.0f) ? 0.0f : system->force_same_m;
        if (prefix_magnitude(force) >= settings->least_force_n) {
            system->without_force_m = 0.0f;
        }
        system->displacement_m = displacement;
        system->force_n = force;
        system->age = 0U;
    } else {
        system->age = prefix_counted(true, system->age);
        found |= PREFIX_MEASUREMENT_MISSED;
        if (system->age > system->most_age) {
            found |= (measured == NULL) ? PREFIX_AGE : PREFIX_IMPLAUSIBLE;
        }
    }
    if (system->phase == PREFIX_RUNNING) {
        if ((system->displacement_same_m > settings->stuck_travel_m)
            || (system->force_same_m > settings->stuck_travel_m)) {
            found |= PREFIX_IMPLAUSIBLE;
        }
        if (system->without_force_m > settings->without_force_m) {
            found |= PREFIX_NO_FORCE;
        }
    }
    if (prefix_magnitude(system->force_n) > settings->force_n) {
        found |= PREFIX_FORCE;
    }
    return found;
}

/* Takes the wanted command (m), the desired displacement (m) and the measured values; returns the command (m). */
PREFIX_INLINE float prefix_guard(prefix_system *system, float wanted_m, float desired_m,
                                 const prefix_measured *measured)
{
    const prefix_settings *const settings = &system->settings;
    const float most = prefix_product(settings->velocity_m_per_s, system->step_s);
    const float slow = prefix_product(settings->approach_m_per_s, system->step_s);
    const float way = wanted_m - system->command_m;
    uint32_t found = prefix_measure(system, measured);
    const bool is_running = system->phase == PREFIX_RUNNING;
    const bool is_limited = is_running && (prefix_magnitude(way) > most);
    const bool is_off =
        is_running && (prefix_magnitude(system->displacement_m - desired_m) > settings->error_m);
    const bool is_in_stroke = (prefix_magnitude(wanted_m) <= settings->stroke_m)
                              && (prefix_magnitude(desired_m) <= settings->stroke_m);
    float change = 0.0f;

    system->limited = prefix_counted(is_limited, system->limited);
    system->off = prefix_counted(is_off, system->off);
    found |= is_in_stroke ? 0U : PREFIX_STROKE;
    found |= is_limited ? PREFIX_COMMAND_LIMITED : 0U;
    found |= (system->limited > system->most_limited) ? PREFIX_VELOCITY : 0U;
    found |= (system->off > system->most_off) ? PREFIX_TRACKING : 0U;
    system->status |= found;
    if (!prefix_has_ended(system) && ((found & ~(PREFIX_COMMAND_LIMITED | PREFIX_MEASUREMENT_MISSED)) != 0U)) {
        prefix_begin_to_end(system);
        change = prefix_ending_change(system);
    } else if (is_running) {
        change = way;
    } else if (system->phase == PREFIX_APPROACHING) {
        if (prefix_magnitude(way) <= slow) {
            system->phase = PREFIX_RUNNING;
        }
        change = prefix_clamped(way, slow);
    } else if (system->phase == PREFIX_ENDING) {
        change = prefix_ending_change(system);
    } else {
        /* held: no change */
    }
    const float next = prefix_clamped(system->command_m + prefix_clamped(change, most), settings->stroke_m);
    system->change_m = next - system->command_m;
    const float travel = prefix_magnitude(system->change_m);
    system->displacement_same_m = system->displacement_same_m + travel;
    system->force_same_m = system->force_same_m + travel;
    system->without_force_m = system->without_force_m + travel;
    system->command_m = next;
    return next;
}

/* Ends the test for a reason that another part found. */
static void prefix_end_for(prefix_system *system, uint32_t reason)
{
    system->status |= reason;
    if (!prefix_has_ended(system)) {
        prefix_begin_to_end(system);
    }
}

void prefix_end(prefix_system *system)
{
    prefix_end_for(system, PREFIX_REQUESTED);
}

bool prefix_clear(prefix_system *system)
{
    if (system->phase == PREFIX_ENDING) {
        return false;
    }
    system->status = 0U;
    system->phase = PREFIX_APPROACHING;
    system->age = 0U;
    system->limited = 0U;
    system->off = 0U;
    system->displacement_same_m = 0.0f;
    system->force_same_m = 0.0f;
    system->without_force_m = 0.0f;
    return true;
}

void prefix_place(prefix_system *system, float displacement_m)
{
    if (!prefix_has_ended(system)) {
        system->phase = PREFIX_APPROACHING;
        system->command_m = prefix_clamped(displacement_m, system->settings.stroke_m);
        system->displacement_m = system->command_m;
        system->change_m = 0.0f;
    }
}
