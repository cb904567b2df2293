
/* Present coefficient of a derivative. */
PREFIX_INLINE float prefix_coefficient(const prefix_system *system, int i)
{
    return system->settings.nominal[i] + prefix_product(system->settings.largest_change[i], system->shares[i]);
}

/* Learns from a tick: the command that was sent and the displacement that was measured. One coefficient in turn takes
 * the products of the tick into its means, and moves to the minimum along it, within its bounds and at its rate. */
PREFIX_INLINE void prefix_learn(prefix_system *system, float sent_m, float measured_m)
{
    float command[4];
    float passed[4];
    float sensed[4];
    int i;

    prefix_chain_push(&system->commands, prefix_credible(sent_m, 1.0f), command);
    prefix_chain_push(&system->measurements, prefix_credible(measured_m, 1.0f), passed);
    float misfit = command[0];
    for (i = 0; i < 4; i++) {
        misfit = misfit - prefix_product(system->scaled_nominal[i], passed[i]);
        sensed[i] = prefix_product(system->sensitivity[i], passed[i]);
    }
    misfit = prefix_product(misfit, system->noise_per_m);
    const float square = prefix_product(passed[1], passed[1]);
    const float faded = system->motion_square - prefix_product(system->fading, system->motion_square);
    system->motion_square = (square > faded) ? square : faded;
    system->is_frozen = system->motion_square < system->least_square;
    if (system->is_frozen) {
        return;
    }
    const uint32_t row = system->turn % 4U;
    system->turn = row + 1U;
    const float share = system->shares[row];
    prefix_fade(&system->misfits[row], system->fading, prefix_product(sensed[row], misfit));
    float slope = system->misfits[row] - share;
    float *const products = system->products[row];
    for (i = 0; i < 4; i++) {
        prefix_fade(&products[i], system->fading, prefix_product(sensed[row], sensed[i]));
        slope = slope - prefix_product(products[i], system->shares[i]);
    }
    const float change = slope / (1.0f + products[row]);
    system->shares[row] = prefix_clamped(share + prefix_clamped(change, system->largest_move), 1.0f);
}

/* Forgets what was learnt: the actuator is at rest at a displacement. */
static void prefix_forget(prefix_system *system, float displacement_m)
{
    int i;
    int j;

    prefix_chain_rest_at(&system->commands, system->settings.nominal[0] * displacement_m);
    prefix_chain_rest_at(&system->measurements, displacement_m);
    for (i = 0; i < 4; i++) {
        for (j = 0; j < 4; j++) {
            system->products[i][j] = 0.0f;
        }
        system->misfits[i] = 0.0f;
        system->shares[i] = 0.0f;
    }
    system->motion_square = 0.0f;
    system->is_frozen = true;
}

/* Takes the desired motion and the measured displacement into the tracking. */
PREFIX_INLINE void prefix_track(prefix_system *system, const prefix_motion *desired, float measured_m)
{
    const float fading = system->tracking_fading;
    const float x = prefix_credible(desired->displacement_m, 1.0f);
    const float v = prefix_credible(desired->velocity_m_per_s, 100.0f);
    const float error = prefix_credible(measured_m, 1.0f) - x;

    prefix_fade(&system->desired_mean, fading, x);
    prefix_fade(&system->velocity_mean, fading, v);
    prefix_fade(&system->error_mean, fading, error);
    const float about_mean = x - system->desired_mean;
    const float velocity = v - system->velocity_mean;
    const float change = error - system->error_mean;
    prefix_fade(&system->desired_square, fading, prefix_product(about_mean, about_mean));
    prefix_fade(&system->velocity_square, fading, prefix_product(velocity, velocity));
    prefix_fade(&system->crossed, fading, prefix_product(about_mean, velocity));
    prefix_fade(&system->with_desired, fading, prefix_product(change, about_mean));
    prefix_fade(&system->with_velocity, fading, prefix_product(change, velocity));
    prefix_fade(&system->error_square, fading, prefix_product(error, error));
}

/* True if the root mean square of the error is too large for the motion, and not tiny. */
PREFIX_INLINE bool prefix_is_off(const prefix_system *system)
{
    const float share = system->settings.tracking_error;
    const float least_m = system->least_error_m;

    return (system->error_square > (share * share * system->desired_square))
           && (system->error_square > (least_m * least_m));
}

/* Takes desired and measured displacement and the measured force into the energy. */
PREFIX_INLINE void prefix_add_energy(prefix_system *system, float desired_m, float measured_m, float force_n)
{
    const float x = prefix_credible(desired_m, 1.0f);
    const float pole = system->energy_pole_per_s;
    const float error_in = prefix_credible(measured_m, 1.0f) - x;
    const float desired = x - prefix_stage(&system->desired, 0, x);
    const float error = error_in - prefix_stage(&system->errors, 0, error_in);
    const float force = prefix_stage(&system->forces, 0, prefix_credible(force_n, 1e7f));
    const float added_w = prefix_product(force * error, pole);
    const float given_w = prefix_product(force * desired, pole);

    system->added_j = prefix_clamped(system->added_j + prefix_product(added_w, system->step_s), 1e12f);
    prefix_fade(&system->added_w, system->energy_fading, added_w);
    prefix_fade(&system->exchanged_w, system->energy_fading, prefix_magnitude(given_w));
    prefix_fade(&system->given_w, system->energy_fading, given_w);
    system->ticks_left = (system->ticks_left > 0U) ? (system->ticks_left - 1U) : 0U;
}

prefix_command prefix_tick(prefix_system *system, const prefix_motion *desired, const prefix_measured *measured)
{
    const float desired_m = desired->displacement_m;
    prefix_command command;
    uint32_t found = 0U;
    float wanted_m = prefix_product(prefix_coefficient(system, 0), desired_m);
    wanted_m = wanted_m + prefix_product(prefix_coefficient(system, 1), desired->velocity_m_per_s);
    wanted_m = wanted_m + prefix_product(prefix_coefficient(system, 2), desired->acceleration_m_per_s2);
    wanted_m = wanted_m + prefix_product(prefix_coefficient(system, 3), desired->jerk_m_per_s3);
    command.command_m = prefix_guard(system, wanted_m, desired_m, measured);
    const bool is_running = system->phase == PREFIX_RUNNING;
    const bool has_started = is_running && !system->was_running;
    system->was_running = is_running;
    prefix_track(system, desired, system->displacement_m);
    /* The tick that starts a test does nothing that other ticks do, so it does not take longer. */
    if (has_started) {
        prefix_forget(system, desired_m);
        prefix_chain_rest_at(&system->desired, prefix_credible(desired_m, 1.0f));
        prefix_chain_rest_at(&system->errors, 0.0f);
        prefix_chain_rest_at(&system->forces, prefix_credible(system->force_n, 1e7f));
        system->added_j = 0.0f;
        system->added_w = 0.0f;
        system->exchanged_w = 0.0f;
        system->given_w = 0.0f;
        system->ticks_left = system->window_ticks;
    } else {
        prefix_add_energy(system, desired_m, system->displacement_m, system->force_n);
        if (is_running) {
            prefix_learn(system, command.command_m, system->displacement_m);
        }
    }
    if ((system->ticks_left == 0U) && (system->exchanged_w >= system->settings.least_power_w)) {
        /* The energy along the measured motion is what the vehicle gives plus what the actuator adds. */
        const float least_w = system->given_w + ((system->added_w < 0.0f) ? system->added_w : 0.0f);

        found |= (system->added_w > (system->settings.largest_share * system->exchanged_w)) ? PREFIX_ENERGY : 0U;
        found |= (least_w < (-0.5f * system->exchanged_w)) ? PREFIX_SIGN : 0U;
    }
    if ((system->tracking_left == 0U) && prefix_is_off(system)) {
        found |= PREFIX_TRACKING;
    }
    const uint32_t tracking_left = system->tracking_left - ((system->tracking_left > 0U) ? 1U : 0U);
    system->tracking_left = is_running ? tracking_left : system->tracking_ticks;
    if (is_running && (found != 0U)) {
        prefix_end_for(system, found);
    }
    if (prefix_has_ended(system)) {
        /* What a rig measures while it comes to rest is no force of the test: after a gap it would jump. */
        system->fading_left -= (system->fading_left > 0U) ? 1U : 0U;
    } else {
        system->fading_left += (system->fading_left < system->fading_ticks) ? 1U : 0U;
        system->vehicle_force_n = system->force_n;
    }
    command.force_n = (float)system->fading_left * system->share_of_tick * system->vehicle_force_n;
    command.status = (uint16_t)system->status;
    command.phase = (uint16_t)system->phase;
    return command;
}

prefix_reading prefix_read(const prefix_system *system)
{
    const float xx = system->desired_square;
    const float vv = system->velocity_square;
    const float xv = system->crossed;
    const float ex = system->with_desired;
    const float ev = system->with_velocity;
    const float determinant = prefix_product(xx, vv) - prefix_product(xv, xv);
    prefix_reading reading = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, {0.0f, 0.0f, 0.0f, 0.0f}, false};
    int i;

    reading.error_m = prefix_root(system->error_square);
    if ((xx > 1e-18f) && (vv > 1e-14f) && (determinant > (1e-4f * xx * vv))) {
        /* error = p x + q v; for a sine, v = omega times the displacement a quarter of a period ahead. */
        const float omega = prefix_root(vv / xx);
        const float p = (prefix_product(ex, vv) - prefix_product(ev, xv)) / determinant;
        const float q = (prefix_product(ev, xx) - prefix_product(ex, xv)) / determinant;
        const float in_phase = 1.0f + p;
        const float behind = -omega * q;

        reading.delay_s = prefix_angle(behind, in_phase) / omega;
        reading.amplitude = prefix_root(prefix_product(in_phase, in_phase) + prefix_product(behind, behind));
        reading.relative_error = reading.error_m / prefix_root(xx);
    }
    reading.added_j = system->added_j;
    reading.added_share = (system->exchanged_w > 1e-9f) ? (system->added_w / system->exchanged_w) : 0.0f;
    for (i = 0; i < 4; i++) {
        reading.coefficients[i] = prefix_coefficient(system, i);
    }
    reading.is_frozen = system->is_frozen;
    return reading;
}
