
void prefix_default_settings(prefix_settings *settings, float stroke_m, float velocity_m_per_s, float force_n)
{
    prefix_set_delay(settings, 0.0f, 0.0f);
    settings->largest_change[0] = 0.0f;
    settings->stroke_m = stroke_m;
    settings->velocity_m_per_s = velocity_m_per_s;
    settings->limited_s = 0.1f;
    settings->force_n = force_n;
    settings->error_m = 0.2f * stroke_m;
    settings->error_s = 0.05f;
    settings->age_s = 0.01f;
    settings->plausible_m_per_s = 4.0f * velocity_m_per_s;
    settings->plausible_n_per_s = 1000.0f * force_n;
    settings->stuck_travel_m = 0.02f * stroke_m;
    settings->least_force_n = 0.002f * force_n;
    settings->without_force_m = stroke_m;
    settings->ramp_s = 0.2f;
    settings->approach_m_per_s = 0.05f * velocity_m_per_s;
    settings->stiffness_n_per_m = 1e7f;
    settings->action = PREFIX_HOLD;
    settings->energy_window_s = 1.0f;
    settings->largest_share = 0.1f;
    settings->least_power_w = 1.0f;
    settings->energy_pole_hz = 50.0f;
    settings->tracking_window_s = 1.0f;
    settings->tracking_error = 0.3f;
}

void prefix_set_delay(prefix_settings *settings, float delay_s, float delay_error_s)
{
    const float error = prefix_magnitude(delay_error_s);
    const float most = prefix_magnitude(delay_s) + error;
    const float square = prefix_product(delay_s, delay_s);

    settings->nominal[0] = 1.0f;
    settings->nominal[1] = delay_s;
    settings->nominal[2] = square / 2.0f;
    settings->nominal[3] = (square * delay_s) / 6.0f;
    settings->largest_change[0] = 0.1f;
    settings->largest_change[1] = delay_error_s;
    settings->largest_change[2] = most * delay_error_s;
    settings->largest_change[3] = 0.5f * most * most * delay_error_s;
    settings->noise_m = 1e-5f;
    settings->least_motion_m = 2e-5f;
    settings->pole_hz = 20.0f;
    settings->memory_s = 2.0f;
    settings->change_s = 1.0f;
}

/* A setting with its range. */
typedef struct prefix_range {
    float value;
    float least;
    float most;
    const char *text;
} prefix_range;

/* Names the first setting that is outside its range; NULL if there is none. */
static const char *prefix_refused(const prefix_settings *settings, float step_s)
{
    const float *const a = settings->nominal;
    const float *const change = settings->largest_change;
    const float tenth_of_rate = 0.1f / step_s;
    const float tenth = (tenth_of_rate < 1000.0f) ? tenth_of_rate : 1000.0f;
    const prefix_range ranges[] = {
        {step_s, 1e-5f, 0.02f, "step_s: 1e-5 to 0.02"},
        {a[0], 0.2f, 5.0f, "nominal[0]: 0.2 to 5"},
        {a[1], -0.2f, 0.2f, "nominal[1]: -0.2 to 0.2"},
        {a[2], -0.02f, 0.02f, "nominal[2]: -0.02 to 0.02"},
        {a[3], -0.002f, 0.002f, "nominal[3]: -0.002 to 0.002"},
        {change[0], 0.0f, 0.5f, "largest_change[0]: 0 to 0.5"},
        {change[1], 0.0f, 0.2f, "largest_change[1]: 0 to 0.2"},
        {change[2], 0.0f, 0.02f, "largest_change[2]: 0 to 0.02"},
        {change[3], 0.0f, 0.002f, "largest_change[3]: 0 to 0.002"},
        {settings->noise_m, 1e-7f, 0.01f, "noise_m: 1e-7 to 0.01"},
        {settings->least_motion_m, 0.0f, 1.0f, "least_motion_m: 0 to 1"},
        {settings->pole_hz, 0.1f, tenth, "pole_hz: 0.1 to 1000 and to a tenth of the rate of the ticks"},
        {settings->memory_s, 0.1f, 1000.0f, "memory_s: 0.1 to 1000"},
        {settings->change_s, 0.01f, 1000.0f, "change_s: 0.01 to 1000"},
        {settings->stroke_m, 1e-4f, 1.0f, "stroke_m: 1e-4 to 1"},
        {settings->velocity_m_per_s, 1e-3f, 10.0f, "velocity_m_per_s: 1e-3 to 10"},
        {settings->limited_s, 0.0f, 10.0f, "limited_s: 0 to 10"},
        {settings->force_n, 1.0f, 1e7f, "force_n: 1 to 1e7"},
        {settings->error_m, 1e-5f, 1.0f, "error_m: 1e-5 to 1"},
        {settings->error_s, 0.0f, 10.0f, "error_s: 0 to 10"},
        {settings->age_s, 0.0f, 10.0f, "age_s: 0 to 10"},
        {settings->plausible_m_per_s, 1e-3f, 1e3f, "plausible_m_per_s: 1e-3 to 1000"},
        {settings->plausible_n_per_s, 1.0f, 1e12f, "plausible_n_per_s: 1 to 1e12"},
        {settings->stuck_travel_m, 1e-6f, 1.0f, "stuck_travel_m: 1e-6 to 1"},
        {settings->least_force_n, 0.0f, 1e7f, "least_force_n: 0 to 1e7"},
        {settings->without_force_m, 1e-6f, 100.0f, "without_force_m: 1e-6 to 100"},
        {settings->ramp_s, 0.01f, 10.0f, "ramp_s: 0.01 to 10"},
        {settings->approach_m_per_s, 1e-4f, 1.0f, "approach_m_per_s: 1e-4 to 1"},
        {settings->stiffness_n_per_m, 1e3f, 1e12f, "stiffness_n_per_m: 1e3 to 1e12"},
        {settings->energy_window_s, 0.05f, 1000.0f, "energy_window_s: 0.05 to 1000"},
        {settings->largest_share, 0.01f, 100.0f, "largest_share: 0.01 to 100"},
        {settings->least_power_w, 0.0f, 1e6f, "least_power_w: 0 to 1e6"},
        {settings->energy_pole_hz, 1.0f, tenth, "energy_pole_hz: 1 to 1000 and to a tenth of the rate of the ticks"},
        {settings->tracking_window_s, 0.05f, 1000.0f, "tracking_window_s: 0.05 to 1000"},
        {settings->tracking_error, 0.01f, 100.0f, "tracking_error: 0.01 to 100"},
    };
    unsigned i;

    for (i = 0U; i < (sizeof(ranges) / sizeof(ranges[0])); i++) {
        const char *refused = prefix_check(ranges[i].value, ranges[i].least, ranges[i].most, ranges[i].text);

        if (refused != NULL) {
            return refused;
        }
    }
    return (settings->action <= PREFIX_ZERO_FORCE) ? NULL : "action: PREFIX_HOLD or PREFIX_ZERO_FORCE";
}

/* Share of the past that fades in a step, for an exponential window. */
static float prefix_fading(float step_s, float window_s)
{
    return 1.0f - prefix_exponential(-step_s / window_s);
}

/* Whole number of ticks in a time; one must not be lost by rounding. */
static uint32_t prefix_ticks(float time_s, float step_s)
{
    return (uint32_t)((time_s / step_s) + 0.01f);
}

const char *prefix_init(prefix_system *system, const prefix_settings *settings, float step_s)
{
    static const prefix_system empty;
    const char *refused = prefix_refused(settings, step_s);
    const float pole_per_s = prefix_product(PREFIX_TAU, settings->pole_hz);
    float sensitivity[4];
    float scaled_nominal[4];
    float power = 1.0f;
    int i;

    for (i = 0; (i < 4) && (refused == NULL); i++) {
        scaled_nominal[i] = settings->nominal[i] * power;
        sensitivity[i] = settings->largest_change[i] * (power / settings->noise_m);
        power = power * pole_per_s;
        refused = prefix_check(sensitivity[i], 0.0f, 1e8f, "noise_m: so large that largest_change times the powers of "
                                                           "the pole is at most 1e8 noises a metre");
    }
    if (refused != NULL) {
        return refused;
    }
    *system = empty;
    system->settings = *settings;
    system->step_s = step_s;
    for (i = 0; i < 4; i++) {
        system->scaled_nominal[i] = scaled_nominal[i];
        system->sensitivity[i] = sensitivity[i];
    }
    system->noise_per_m = 1.0f / settings->noise_m;
    system->least_square = settings->least_motion_m * settings->least_motion_m;
    system->fading = prefix_fading(4.0f * step_s, settings->memory_s);
    system->largest_move = 4.0f * step_s / settings->change_s;
    prefix_chain_init(&system->commands, pole_per_s, step_s);
    system->measurements = system->commands;
    system->is_frozen = true;

    system->tracking_fading = prefix_fading(step_s, settings->tracking_window_s);
    system->tracking_ticks = (uint32_t)(settings->tracking_window_s / step_s);
    system->tracking_left = system->tracking_ticks;
    system->least_error_m = 0.01f * settings->error_m;
    system->energy_fading = prefix_fading(step_s, settings->energy_window_s);
    system->energy_pole_per_s = prefix_product(PREFIX_TAU, settings->energy_pole_hz);
    prefix_chain_init(&system->desired, system->energy_pole_per_s, step_s);
    system->errors = system->desired;
    system->forces = system->desired;
    system->window_ticks = (uint32_t)(settings->energy_window_s / step_s);
    system->ticks_left = system->window_ticks;

    system->phase = PREFIX_APPROACHING;
    system->most_age = prefix_ticks(settings->age_s, step_s);
    system->most_limited = prefix_ticks(settings->limited_s, step_s);
    system->most_off = prefix_ticks(settings->error_s, step_s);
    const float fading_ticks = settings->ramp_s / step_s;
    system->fading_ticks = (uint32_t)fading_ticks;
    if ((float)system->fading_ticks < fading_ticks) {
        system->fading_ticks = system->fading_ticks + 1U;
    }
    system->fading_left = system->fading_ticks;
    system->share_of_tick = 1.0f / (float)system->fading_ticks;
    return NULL;
}
