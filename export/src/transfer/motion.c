
#define PREFIX_TAU 6.28318530717958647692f

static void prefix_chain_rest_at(prefix_chain *chain, float value)
{
    chain->memory[0] = value;
    chain->memory[1] = value;
    chain->memory[2] = value;
}

/* Low-pass filters of first order in a chain, by the trapezoidal rule, at rest at 0. */
static void prefix_chain_init(prefix_chain *chain, float pole_per_s, float step_s)
{
    const float g = prefix_product(prefix_product(0.5f, pole_per_s), step_s);

    prefix_chain_rest_at(chain, 0.0f);
    chain->gain = g / (1.0f + g);
}

/* Takes a value; returns that after a stage. */
PREFIX_INLINE float prefix_stage(prefix_chain *chain, int stage, float value)
{
    const float change = prefix_product(value - chain->memory[stage], chain->gain);
    const float passed = chain->memory[stage] + change;

    chain->memory[stage] = passed + change;
    return passed;
}

/* Takes a displacement; returns the low-passed displacement and its first three derivatives, divided by the first three
 * powers of the pole. */
PREFIX_INLINE void prefix_chain_push(prefix_chain *chain, float x, float derivatives[4])
{
    const float a = prefix_stage(chain, 0, x);
    const float b = prefix_stage(chain, 1, a);
    const float c = prefix_stage(chain, 2, b);
    const float first = x - a;
    const float second = a - b;
    const float third = b - c;

    derivatives[0] = c;
    derivatives[1] = third;
    derivatives[2] = second - third;
    derivatives[3] = (first - second) - (second - third);
}

/* Returns NULL if `value` is from `least` to `most`, else `text`. */
static const char *prefix_check(float value, float least, float most, const char *text)
{
    return ((value >= least) && (value <= most)) ? NULL : text;
}

const char *prefix_motion_filter_init(prefix_motion_filter *filter, float pole_hz, float step_s)
{
    const char *refused = prefix_check(step_s, 1e-5f, 0.02f, "step_s: 1e-5 to 0.02");

    if (refused == NULL) {
        refused = prefix_check(pole_hz, 1.0f, 0.25f / step_s, "pole_hz: 1 to a quarter of the rate of the ticks");
    }
    if (refused == NULL) {
        filter->pole_per_s = prefix_product(PREFIX_TAU, pole_hz);
        prefix_chain_init(&filter->chain, filter->pole_per_s, step_s);
    }
    return refused;
}

void prefix_motion_filter_rest_at(prefix_motion_filter *filter, float displacement_m)
{
    prefix_chain_rest_at(&filter->chain, displacement_m);
}

prefix_motion prefix_motion_filter_push(prefix_motion_filter *filter, float displacement_m)
{
    const float w = filter->pole_per_s;
    float passed[4];
    prefix_motion motion;

    prefix_chain_push(&filter->chain, displacement_m, passed);
    motion.displacement_m = displacement_m;
    motion.velocity_m_per_s = w * (passed[1] + prefix_product(3.0f, passed[2] + passed[3]));
    motion.acceleration_m_per_s2 = w * w * (passed[2] + prefix_product(3.0f, passed[3]));
    motion.jerk_m_per_s3 = w * w * w * passed[3];
    return motion;
}
