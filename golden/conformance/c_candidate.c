/* A candidate in C: stages 0 to 2 of a psmrt conformance kit, written from the kit's README.
 *
 *   cc -std=c99 -O2 -o c_candidate c_candidate.c -lm
 *   ./c_candidate kit candidate
 *
 * It numbers the directions in the kit's order. Which parts a collision has is seen from the arrays that
 * are given with it. */
#define _POSIX_C_SOURCE 200809L
#include "psmrt_kit.h"

#define Q 19
#define KIT_VERSION 3

static const int C[Q][3] = {
    {0, 0, 0},  {1, 0, 0},   {-1, 0, 0}, {0, 1, 0},  {0, -1, 0},  {0, 0, 1},  {0, 0, -1},
    {1, 1, 0},  {-1, 1, 0},  {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1}, {1, 0, -1},
    {-1, 0, -1}, {0, 1, 1},  {0, -1, 1}, {0, 1, -1}, {0, -1, -1}};

static double W[Q], M[Q][Q], norm[Q];
static int opposite[Q];

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static double along(int a, const double *v) { return C[a][0] * v[0] + C[a][1] * v[1] + C[a][2] * v[2]; }

static void prepare(void) {
    for (int a = 0; a < Q; a++) {
        double x = C[a][0], y = C[a][1], z = C[a][2], s = x * x + y * y + z * z;
        double rows[Q] = {1, 19 * s - 30, (21 * s * s - 53 * s + 24) / 2, x, (5 * s - 9) * x, y,
                          (5 * s - 9) * y, z, (5 * s - 9) * z, 3 * x * x - s, (3 * s - 5) * (3 * x * x - s),
                          y * y - z * z, (3 * s - 5) * (y * y - z * z), x * y, y * z, x * z,
                          (y * y - z * z) * x, (z * z - x * x) * y, (x * x - y * y) * z};
        for (int k = 0; k < Q; k++) {
            M[k][a] = rows[k];
            norm[k] += rows[k] * rows[k];
        }
        W[a] = s == 0 ? 1.0 / 3 : s == 1 ? 1.0 / 18 : 1.0 / 36;
        for (int b = 0; b < Q; b++)
            if (C[b][0] == -C[a][0] && C[b][1] == -C[a][1] && C[b][2] == -C[a][2]) opposite[a] = b;
    }
}

static void conserved(const double *f, double *rho, double j[3]) {
    *rho = j[0] = j[1] = j[2] = 0;
    for (int a = 0; a < Q; a++) {
        *rho += f[a];
        for (int i = 0; i < 3; i++) j[i] += C[a][i] * f[a];
    }
}

static void equilibrium(double rho, const double u[3], double f_eq[Q]) {
    for (int a = 0; a < Q; a++) {
        double cu = along(a, u);
        f_eq[a] = W[a] * rho * (1 + 3 * cu + 4.5 * cu * cu - 1.5 * dot(u, u));
    }
}

/* m = M f */
static void moments(const double *f, double m[Q]) {
    for (int k = 0; k < Q; k++) {
        m[k] = 0;
        for (int a = 0; a < Q; a++) m[k] += M[k][a] * f[a];
    }
}

/* out += M^-1 diag(s) M f; the rows of M are orthogonal. With rates = NULL: out += f/tau. */
static void relaxed(const double *f, const double *s, double rate, double out[Q]) {
    double m[Q];
    moments(f, m);
    for (int a = 0; a < Q; a++) {
        if (!s) out[a] += rate * f[a];
        for (int k = 0; s && k < Q; k++) out[a] += M[k][a] / norm[k] * s[k] * m[k];
    }
}

static void s_hat(const double r[6], double s[Q]) {
    double e = r[0], eps = r[1], q = r[2], nu = r[3], pi = r[4], m = r[5];
    double diagonal[Q] = {0, e, eps, 0, q, 0, q, 0, q, nu, pi, nu, pi, nu, nu, nu, m, m, m};
    memcpy(s, diagonal, sizeof diagonal);
}

/* Omega = -(relaxation of f - f_eq) */
static void omega(const double *f, double rho, const double u[3], const double *s, double tau, double out[Q]) {
    double f_neq[Q];
    equilibrium(rho, u, f_neq);
    for (int a = 0; a < Q; a++) {
        f_neq[a] -= f[a];
        out[a] = 0;
    }
    relaxed(f_neq, s, 1 / tau, out);
}

static kit_array given(const char *kit, const char *problem, const char *name) {
    char path[4096];
    kit_array none = {NULL, 0, {0}, 0};
    snprintf(path, sizeof path, "%s/problems/%s/given/%s.npy", kit, problem, name);
    return kit_exists(path) ? kit_read(path) : none;
}

static void constants(const char *kit, const char *out) {
    double s[Q], numbers[Q], directions[Q][3], rates[6] = {1.19, 1.4, 1.2, 1 / 0.8, 1.4, 1.98};
    kit_array nu = given(kit, "constants", "viscosity");
    for (int a = 0; a < Q; a++) {
        numbers[a] = opposite[a];
        for (int i = 0; i < 3; i++) directions[a][i] = C[a][i];
    }
    for (size_t i = 0; i < nu.count; i++) nu.values[i] = 3 * nu.values[i] + 0.5;
    s_hat(rates, s);
    kit_write(out, "constants", "directions", &directions[0][0], 2, (size_t[]){Q, 3});
    kit_write(out, "constants", "weights", W, 1, (size_t[]){Q});
    kit_write(out, "constants", "opposites", numbers, 1, (size_t[]){Q});
    kit_write(out, "constants", "moment_matrix", &M[0][0], 2, (size_t[]){Q, Q});
    kit_write(out, "constants", "s_hat", s, 1, (size_t[]){Q});
    kit_write(out, "constants", "relaxation_time", nu.values, 1, nu.shape);
    free(nu.values);
}

static void states(const char *kit, const char *out) {
    kit_array f = given(kit, "moments", "f"), rho = given(kit, "moments", "rho"), u = given(kit, "moments", "u");
    size_t n = f.shape[0], at = rho.count;
    double *density = calloc(n, sizeof(double)), *momentum = calloc(3 * n, sizeof(double)), *m = calloc(Q * n, sizeof(double));
    double *f_eq = calloc(Q * at, sizeof(double)), *m_eq = calloc(Q * at, sizeof(double));
    for (size_t i = 0; i < n; i++) {
        conserved(f.values + Q * i, density + i, momentum + 3 * i);
        moments(f.values + Q * i, m + Q * i);
    }
    for (size_t i = 0; i < at; i++) {
        equilibrium(rho.values[i], u.values + 3 * i, f_eq + Q * i);
        moments(f_eq + Q * i, m_eq + Q * i);
    }
    kit_write(out, "moments", "density", density, 1, &n);
    kit_write(out, "moments", "momentum", momentum, 2, (size_t[]){n, 3});
    kit_write(out, "moments", "moments", m, 2, (size_t[]){n, Q});
    kit_write(out, "moments", "equilibrium", f_eq, 2, (size_t[]){at, Q});
    kit_write(out, "moments", "equilibrium_moments", m_eq, 2, (size_t[]){at, Q});
}

/* A cell of solid fraction epsilon > 0 as fluid of graded viscosity. */
static void graded(double f[Q], double tau, const double *g, double epsilon, const double u_p[3], double force[3]) {
    double excess = tau - 0.5, open = 1 - epsilon, k = excess * excess / (4 * excess + 0.4);
    double B = k * epsilon / (open + k * epsilon), rho, j[3], total[3], u[3], s[Q], f_neq[Q], source[Q], half[Q] = {0};
    double even = open / (open / 2 + excess), odd = 1 / (0.5 + 0.002 * open / excess);
    s_hat((double[]){even, even, odd, even, even, odd}, s);
    conserved(f, &rho, j);
    for (int i = 0; i < 3; i++) {
        force[i] = -2 * B * (rho * u_p[i] - j[i]);
        total[i] = (1 - B) * (g ? g[i] : 0) - force[i];
        u[i] = (j[i] + total[i] / 2) / rho;
    }
    equilibrium(rho, u, f_neq);
    for (int a = 0; a < Q; a++) {
        f_neq[a] -= f[a];
        source[a] = W[a] * (3 * (along(a, total) - dot(u, total)) + 9 * along(a, u) * along(a, total));
    }
    relaxed(f_neq, s, 0, f);
    relaxed(source, s, 0, half);
    for (int a = 0; a < Q; a++) f[a] += source[a] - half[a] / 2;
}

/* One cell: f becomes f*, force is that on the solid. What is absent is NULL. */
static void collide(double f[Q], double tau, const double *rates, const double *g, const double *epsilon,
                    const double *u_p, const char *problem, double force[3]) {
    const int superposition = strstr(problem, "superposition") != NULL;
    const int whole = strstr(problem, "full_bounce_back") != NULL;
    double rho, j[3], bare[3], u[3], s[Q], change[Q], *diagonal = NULL, B = 0;
    if (epsilon && *epsilon > 0 && strstr(problem, "graded_viscosity")) {
        graded(f, tau, g, *epsilon, u_p, force);
        return;
    }
    conserved(f, &rho, j);
    for (int i = 0; i < 3; i++) {
        bare[i] = j[i] / rho;
        u[i] = (j[i] + (g ? g[i] / 2 : 0)) / rho;
    }
    if (rates) s_hat(rates, diagonal = s);
    omega(f, rho, u, diagonal, tau, change);
    if (g) {
        /* Guo's source, less half of what relaxes of it. */
        double source[Q], half[Q] = {0};
        for (int a = 0; a < Q; a++)
            source[a] = W[a] * (3 * (along(a, g) - dot(u, g)) + 9 * along(a, u) * along(a, g));
        relaxed(source, diagonal, 1 / tau, half);
        for (int a = 0; a < Q; a++) change[a] += source[a] - half[a] / 2;
    }
    double lambda[Q] = {0};
    if (epsilon && *epsilon > 0) {
        double f_eq[Q], solid[Q], relaxation[Q];
        B = *epsilon * (tau - 0.5) / ((1 - *epsilon) + (tau - 0.5));
        equilibrium(rho, bare, f_eq);
        equilibrium(rho, u_p, solid);
        omega(f, rho, bare, diagonal, tau, relaxation);
        for (int a = 0; a < Q; a++) {
            int b = opposite[a];
            const double *turned = whole ? solid : f_eq;
            lambda[a] = superposition ? solid[a] - f_eq[a] + relaxation[a] : f[b] - turned[b] + solid[a] - f[a];
        }
    }
    force[0] = force[1] = force[2] = 0;
    for (int a = 0; a < Q; a++) {
        for (int i = 0; i < 3; i++) force[i] -= B * lambda[a] * C[a][i];
        f[a] += (1 - B) * change[a] + B * lambda[a];
    }
}

static void collisions(const char *kit, const char *out, const char *problem) {
    kit_array f = given(kit, problem, "f"), tau = given(kit, problem, "tau"), rates = given(kit, problem, "rates");
    kit_array g = given(kit, problem, "body_force"), epsilon = given(kit, problem, "epsilon");
    kit_array u_p = given(kit, problem, "u_p");
    size_t n = tau.count;
    double *force = calloc(3 * n, sizeof(double));
    for (size_t i = 0; i < n; i++)
        collide(f.values + Q * i, tau.values[i], rates.values ? rates.values + 6 * i : NULL,
                g.values ? g.values + 3 * i : NULL, epsilon.values ? epsilon.values + i : NULL,
                u_p.values ? u_p.values + 3 * i : NULL, problem, force + 3 * i);
    kit_write(out, problem, "post", f.values, 2, (size_t[]){n, Q});
    if (epsilon.values) kit_write(out, problem, "force", force, 2, (size_t[]){n, 3});
}

int main(int count, char **arguments) {
    static const char *const problems[] = {
        "srt", "mrt", "srt_force", "mrt_force", "ps_srt", "ps_mrt", "ps_srt_force", "ps_mrt_force",
        "ps_srt_superposition", "ps_mrt_superposition", "ps_srt_full_bounce_back", "ps_mrt_full_bounce_back",
        "ps_srt_graded_viscosity", "ps_mrt_graded_viscosity"};
    if (count != 3) {
        fprintf(stderr, "usage: %s KIT CANDIDATE\n", arguments[0]);
        return 2;
    }
    prepare();
    constants(arguments[1], arguments[2]);
    states(arguments[1], arguments[2]);
    for (size_t i = 0; i < sizeof problems / sizeof *problems; i++)
        collisions(arguments[1], arguments[2], problems[i]);
    kit_manifest(arguments[2], "C candidate", "f64", C, KIT_VERSION);
    return 0;
}
