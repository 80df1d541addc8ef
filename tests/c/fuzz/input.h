/* What the fuzzer's bytes mean: numbers, indices, lists and structs, mostly sane, some on purpose not. */
#ifndef MUSLIN_FUZZ_INPUT_H
#define MUSLIN_FUZZ_INPUT_H

#include <float.h>
#include <math.h>
#include <muslin.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const uint8_t *at, *end;

/* The next byte; 0 when there are no more. */
static uint32_t byte(void) { return at < end ? *at++ : 0; }

static uint32_t word(void) {
  uint32_t low = byte(), high = byte();
  low |= high << 8;
  high = byte();
  return low | high << 16 | byte() << 24;
}

/* Whether this argument is a sane one: most are, so that a sequence gets somewhere. */
static int is_sane(void) { return byte() < 232; }

/* Some number; when sane within -8 to 8. */
static float number(void) {
  const float odd[] = {NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX, 1e-40f, -0.0f, 1e20f, -1, 0};
  if (is_sane()) return (float)(int8_t)byte() / 16.0f;
  const uint32_t choice = byte() % 11;
  if (choice < 10) return odd[choice];
  const uint32_t bits = word();
  float raw;
  memcpy(&raw, &bits, sizeof raw);
  return raw;
}

/* Some number; when sane from 0 to 8. */
static float at_least_0(void) {
  const float n = number();
  return n < 0 && n >= -8 ? -n : n;
}

/* Some whole number; when sane below `limit`. */
static uint32_t below(uint32_t limit) {
  if (is_sane()) return (byte() | byte() << 8) % (limit > 0 ? limit : 1);
  const uint32_t odd[] = {limit, limit + 1, 0, 1, UINT32_MAX, UINT32_MAX - 1, 0x80000000u, 0x10000u};
  const uint32_t choice = byte() % 9;
  return choice < 8 ? odd[choice] : word();
}

static MuslinVec3 vector(void) {
  MuslinVec3 v;
  v.x = number();
  v.y = number();
  v.z = number();
  return v;
}

/* Half of the time a direction that leads to where cloths are made. */
static MuslinVec3 aim(void) {
  const MuslinVec3 ahead = {0, 0, -1}, behind = {0, 0, 1};
  const uint32_t choice = byte() % 4;
  return choice == 0 ? ahead : choice == 1 ? behind : vector();
}

/* Which of the handles that are kept: mostly the first one. */
static uint32_t handle(void) {
  const uint32_t choice = byte() % 8;
  return choice < 4 ? choice : 0;
}

/* A unit quaternion when sane. */
static MuslinQuat rotation(void) {
  const MuslinQuat turns[] = {{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 0.6f, 0, 0.8f}, {0.5f, 0.5f, 0.5f, 0.5f}};
  if (is_sane()) return turns[byte() % 4];
  MuslinQuat q = {number(), number(), 0, 1};
  return q;
}

/* Memory of this call, exactly as large as it is said to be, sometimes askew: what is touched beyond it, or
 * after the call, the address sanitizer sees. */
enum { MAX_ROOMS = 64 };
static void *rooms[MAX_ROOMS];
static int room_count = 0;

static void *room(size_t size) {
  const size_t askew = is_sane() ? 0 : 1 + byte() % 7;
  uint8_t *memory = malloc(size + askew);
  if (memory == NULL || room_count == MAX_ROOMS) abort();
  memset(memory, 0xee, size + askew);
  rooms[room_count++] = memory;
  return memory + askew;
}

/* As malloc aligns it: for buffers that must be. */
static void *aligned_room(size_t size) {
  void *memory = malloc(size);
  if (memory == NULL || room_count == MAX_ROOMS) abort();
  memset(memory, 0xee, size);
  return rooms[room_count++] = memory;
}

static void leave_rooms(void) {
  while (room_count > 0) free(rooms[--room_count]);
}

/* Where a result goes: seldom NULL. */
static void *out(size_t size) { return is_sane() ? room(size) : NULL; }

/* A list of `count` whole numbers below `limit`; seldom NULL. */
static uint32_t *list(uint32_t count, uint32_t limit) {
  if (!is_sane()) return NULL;
  uint8_t *bytes = room(4 * (size_t)count);
  for (uint32_t i = 0; i < count; i++) {
    const uint32_t value = below(limit);
    memcpy(bytes + 4 * (size_t)i, &value, 4);
  }
  return (uint32_t *)(void *)bytes;
}

/* A list of `count` numbers; seldom NULL. */
static float *numbers(uint32_t count, float (*one)(void)) {
  if (!is_sane()) return NULL;
  uint8_t *bytes = room(4 * (size_t)count);
  for (uint32_t i = 0; i < count; i++) {
    const float value = one();
    memcpy(bytes + 4 * (size_t)i, &value, 4);
  }
  return (float *)(void *)bytes;
}

/* Distances between points, the last four refused. */
static uint32_t stride(void) {
  const uint32_t strides[] = {0, 0, 12, 12, 16, 20, 32, 4, 13, 10, UINT32_MAX};
  return strides[byte() % 11];
}

/* `count` points so far apart; seldom NULL. */
static float *points(uint32_t count, uint32_t apart) {
  if (!is_sane()) return NULL;
  const size_t step = apart < 12 || apart > 64 ? 12 : apart;
  uint8_t *bytes = room(count > 0 ? step * (count - 1) + 12 : 0);
  for (uint32_t i = 0; i < count; i++) {
    const MuslinVec3 point = vector();
    memcpy(bytes + step * i, &point, 12);
  }
  return (float *)(void *)bytes;
}

/* Overwrites a few of the 4-byte fields of a struct that has begun. */
static void poke(void *of, size_t size) {
  uint8_t *bytes = of;
  for (uint32_t n = byte() % 4; n > 0; n--) {
    const size_t field = 4 * (byte() % (size / 4));
    const uint32_t kind = byte() % 4;
    if (kind == 0) {
      const uint32_t value = below(8);
      memcpy(bytes + field, &value, 4);
    } else {
      const float value = kind == 1 ? number() : at_least_0() / 8.0f;
      memcpy(bytes + field, &value, 4);
    }
  }
}

/* The struct in memory of just the size that it says. */
static void *told(const void *of, size_t size) {
  uint32_t says;
  memcpy(&says, of, 4);
  size_t takes = says < 4 ? 4 : says > 4096 ? 4096 : says;
  if (!is_sane()) {
    /* A program of another time; none has a struct that ends amid a pointer. */
    takes = size - 16 + 8 * (byte() % 5);
    says = (uint32_t)takes;
  }
  uint8_t *bytes = room(takes);
  if (byte() % 4 != 0) memset(bytes, 0, takes);
  memcpy(bytes, of, takes < size ? takes : size);
  memcpy(bytes, &says, 4);
  return bytes;
}

#endif
