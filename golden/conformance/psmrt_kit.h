/* Reading problems of a psmrt conformance kit and writing answers, in C99 and POSIX mkdir.
 *
 *   kit_array f = kit_read("kit/problems/srt/given/f.npy");   f.values, f.shape[0..f.axes-1]
 *   kit_write("candidate", "srt", "post", values, 2, (size_t[]){n, 19});
 *   kit_manifest("candidate", "my code", "f64", directions, 1);
 *
 * Any error ends the program with a message. The kit's arrays are little-endian double precision in C
 * order, and so is what is written: this header is for little-endian machines. */
#ifndef PSMRT_KIT_H
#define PSMRT_KIT_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define KIT_MAX_AXES 5

typedef struct {
    double *values;
    size_t axes, shape[KIT_MAX_AXES], count;
} kit_array;

static inline void kit_fail(const char *path, const char *why) {
    fprintf(stderr, "%s: %s\n", path, why);
    exit(2);
}

static inline int kit_exists(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

/* Reads an array of the kit: format version 1, '<f8', C order. */
static inline kit_array kit_read(const char *path) {
    kit_array array = {NULL, 0, {0}, 1};
    unsigned char start[10];
    FILE *file = fopen(path, "rb");
    if (!file) kit_fail(path, "cannot be read");
    if (fread(start, 1, 10, file) != 10 || memcmp(start, "\x93NUMPY\x01", 7) != 0)
        kit_fail(path, "is no .npy file of version 1");
    size_t length = start[8] | (size_t)start[9] << 8;
    char *header = (char *)calloc(length + 1, 1);
    if (!header || fread(header, 1, length, file) != length) kit_fail(path, "has no header");
    if (!strstr(header, "'<f8'") || !strstr(header, "'fortran_order': False"))
        kit_fail(path, "is not little-endian double precision in C order");
    char *at = strstr(header, "'shape': (");
    if (!at) kit_fail(path, "has no shape");
    at += strlen("'shape': (");
    while (*at >= '0' && *at <= '9') {
        if (array.axes == KIT_MAX_AXES) kit_fail(path, "has too many axes");
        array.shape[array.axes] = strtoull(at, &at, 10);
        array.count *= array.shape[array.axes++];
        while (*at == ',' || *at == ' ') at++;
    }
    array.values = (double *)malloc((array.count ? array.count : 1) * sizeof(double));
    if (!array.values || fread(array.values, sizeof(double), array.count, file) != array.count)
        kit_fail(path, "ends early");
    free(header);
    fclose(file);
    return array;
}

/* Makes a folder unless it is there. */
static inline void kit_folder(const char *path) {
    if (!kit_exists(path) && mkdir(path, 0777) != 0) kit_fail(path, "cannot be made");
}

/* Writes an answer to folder/problem/name.npy. */
static inline void kit_write(const char *folder, const char *problem, const char *name,
                             const double *values, size_t axes, const size_t *shape) {
    char path[4096], lengths[256] = "", header[512];
    size_t count = 1;
    kit_folder(folder);
    snprintf(path, sizeof path, "%s/%s", folder, problem);
    kit_folder(path);
    snprintf(path, sizeof path, "%s/%s/%s.npy", folder, problem, name);
    for (size_t i = 0; i < axes; i++) {
        size_t used = strlen(lengths);
        snprintf(lengths + used, sizeof lengths - used, "%zu, ", shape[i]);
        count *= shape[i];
    }
    snprintf(header, sizeof header, "{'descr': '<f8', 'fortran_order': False, 'shape': (%s), }", lengths);
    size_t length = (10 + strlen(header) + 1 + 63) / 64 * 64 - 10;
    unsigned char start[10] = {0x93, 'N', 'U', 'M', 'P', 'Y', 1, 0, (unsigned char)length, (unsigned char)(length >> 8)};
    FILE *file = fopen(path, "wb");
    if (!file) kit_fail(path, "cannot be written");
    fwrite(start, 1, 10, file);
    fprintf(file, "%-*s\n", (int)length - 1, header);
    if (fwrite(values, sizeof(double), count, file) != count || fclose(file) != 0)
        kit_fail(path, "cannot be written");
}

/* Writes the candidate's manifest; directions is your order, 19 triples. */
static inline void kit_manifest(const char *folder, const char *name, const char *precision,
                                const int directions[19][3], int kit_version) {
    char path[4096];
    kit_folder(folder);
    snprintf(path, sizeof path, "%s/manifest.json", folder);
    FILE *file = fopen(path, "w");
    if (!file) kit_fail(path, "cannot be written");
    fprintf(file, "{\"name\": \"%s\", \"precision\": \"%s\", \"kit_version\": %d, \"directions\": [", name, precision, kit_version);
    for (int a = 0; a < 19; a++)
        fprintf(file, "%s[%d, %d, %d]", a ? ", " : "", directions[a][0], directions[a][1], directions[a][2]);
    fprintf(file, "]}\n");
    fclose(file);
}

#endif
