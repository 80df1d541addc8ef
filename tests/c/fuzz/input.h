/* Decodes the fuzzer's bytes into numbers, indices, lists and structs: mostly valid, some deliberately invalid. */
#ifndef MUSLIN_FUZZ_INPUT_H
#define MUSLIN_FUZZ_INPUT_H

#include <float.h>
#include <math.h>
#include <muslin.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static const uint8_t *at, *end;

/* The next byte; 0 at the end. */
static uint32_t byte(void) { return at < end ? *at++ : 0; }

static uint32_t word(void) {
  uint32_t low = byte(), high = byte();
  low |= high << 8;
  high = byte();
  return low | high << 16 | byte() << 24;
}

/* Whether this argument is valid: most are, so that sequences of calls make progress. */
static int is_valid(void) { return byte() < 232; }

/* A number; from -8 to 8 if valid. */
static float number(void) {
  const float odd[] = {NAN, INFINITY, -INFINITY, FLT_MAX, -FLT_MAX, 1e-40f, -0.0f, 1e20f, -1, 0};
  if (is_valid()) return (float)(int8_t)byte() / 16.0f;
  const uint32_t choice = byte() % 11;
  if (choice < 10) return odd[choice];
  const uint32_t bits = word();
  float raw;
  memcpy(&raw, &bits, sizeof raw);
  return raw;
}

/* A number; from 0 to 8 if valid. */
static float at_least_0(void) {
  const float n = number();
  return n < 0 && n >= -8 ? -n : n;
}

/* An integer; below `limit` if valid. */
static uint32_t below(uint32_t limit) {
  if (is_valid()) return (byte() | byte() << 8) % (limit > 0 ? limit : 1);
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

/* A direction; half of the time it points to where cloths are made. */
static MuslinVec3 aim(void) {
  const MuslinVec3 ahead = {0, 0, -1}, behind = {0, 0, 1};
  const uint32_t choice = byte() % 4;
  return choice == 0 ? ahead : choice == 1 ? behind : vector();
}

/* Index of a stored handle: mostly the first one. */
static uint32_t handle(void) {
  const uint32_t choice = byte() % 8;
  return choice < 4 ? choice : 0;
}

/* A rotation; a unit quaternion if valid. */
static MuslinQuat rotation(void) {
  const MuslinQuat turns[] = {{0, 0, 0, 1}, {1, 0, 0, 0}, {0, 0.6f, 0, 0.8f}, {0.5f, 0.5f, 0.5f, 0.5f}};
  if (is_valid()) return turns[byte() % 4];
  MuslinQuat q = {number(), number(), 0, 1};
  return q;
}

/* Memory for this call, of exactly the stated size, sometimes unaligned: the address sanitizer detects accesses
 * beyond it or after the call. */
enum { MAX_BLOCKS = 64 };
static void *blocks[MAX_BLOCKS];
static int block_count = 0;

static void *memory_of(size_t size) {
  const size_t offset = is_valid() ? 0 : 1 + byte() % 7;
  uint8_t *memory = malloc(size + offset);
  if (memory == NULL || block_count == MAX_BLOCKS) abort();
  memset(memory, 0xee, size + offset);
  blocks[block_count++] = memory;
  return memory + offset;
}

/* Memory with the alignment of malloc, for buffers that must be aligned. */
static void *aligned_memory(size_t size) {
  void *memory = malloc(size);
  if (memory == NULL || block_count == MAX_BLOCKS) abort();
  memset(memory, 0xee, size);
  return blocks[block_count++] = memory;
}

static void free_all_memory(void) {
  while (block_count > 0) free(blocks[--block_count]);
}

/* Memory for an output parameter; seldom NULL. */
static void *out(size_t size) { return is_valid() ? memory_of(size) : NULL; }

/* A list of `count` integers below `limit`; seldom NULL. */
static uint32_t *list(uint32_t count, uint32_t limit) {
  if (!is_valid()) return NULL;
  uint8_t *bytes = memory_of(4 * (size_t)count);
  for (uint32_t i = 0; i < count; i++) {
    const uint32_t value = below(limit);
    memcpy(bytes + 4 * (size_t)i, &value, 4);
  }
  return (uint32_t *)(void *)bytes;
}

/* A list of `count` numbers; seldom NULL. */
static float *numbers(uint32_t count, float (*one)(void)) {
  if (!is_valid()) return NULL;
  uint8_t *bytes = memory_of(4 * (size_t)count);
  for (uint32_t i = 0; i < count; i++) {
    const float value = one();
    memcpy(bytes + 4 * (size_t)i, &value, 4);
  }
  return (float *)(void *)bytes;
}

/* Strides of points; the last four are refused. */
static uint32_t stride(void) {
  const uint32_t strides[] = {0, 0, 12, 12, 16, 20, 32, 4, 13, 10, UINT32_MAX};
  return strides[byte() % 11];
}

/* `count` points with a stride of `step_bytes` bytes; seldom NULL. */
static float *points(uint32_t count, uint32_t step_bytes) {
  if (!is_valid()) return NULL;
  const size_t step = step_bytes < 12 || step_bytes > 64 ? 12 : step_bytes;
  uint8_t *bytes = memory_of(count > 0 ? step * (count - 1) + 12 : 0);
  for (uint32_t i = 0; i < count; i++) {
    const MuslinVec3 point = vector();
    memcpy(bytes + step * i, &point, 12);
  }
  return (float *)(void *)bytes;
}

/* Overwrites a few of the 4-byte fields of an initialised struct. */
static void corrupt(void *of, size_t size) {
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

/* Copies the struct into memory of exactly the size that it states. */
static void *copy_with_size(const void *of, size_t size) {
  uint32_t says;
  memcpy(&says, of, 4);
  size_t takes = says < 4 ? 4 : says > 4096 ? 4096 : says;
  if (!is_valid()) {
    /* The struct size of another version; no version ends in the middle of a pointer. */
    takes = size - 16 + 8 * (byte() % 5);
    says = (uint32_t)takes;
  }
  uint8_t *bytes = memory_of(takes);
  if (byte() % 4 != 0) memset(bytes, 0, takes);
  memcpy(bytes, of, takes < size ? takes : size);
  memcpy(bytes, &says, 4);
  return bytes;
}

#endif
