/* Minimal test macros: a check, a line per test, and a count of failures. */
#ifndef MUSLIN_CHECK_H
#define MUSLIN_CHECK_H

#include <muslin.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

/* Checks a condition; prints and counts a failure. */
#define CHECK(claim)                                                                      \
  do {                                                                                    \
    if (!(claim)) {                                                                       \
      failures++;                                                                         \
      fprintf(stderr, "%s:%d: not so: %s (last error: %s)\n", __FILE__, __LINE__, #claim, \
              muslin_last_error());                                                       \
    }                                                                                     \
  } while (0)

/* Checks that a call succeeds. */
#define DONE(call) CHECK((call) == MUSLIN_STATUS_OK)

/* Checks that a call returns the status, with a message that contains `words`. */
#define REFUSED(call, status, words)                        \
  do {                                                      \
    CHECK((call) == (status));                              \
    CHECK(strstr(muslin_last_error(), (words)) != NULL);    \
  } while (0)

/* Runs a test and prints its name. */
#define TEST(test)                                                          \
  do {                                                                      \
    int before = failures;                                                  \
    test();                                                                 \
    printf("%s %s\n", failures == before ? "  ok" : "FAIL", #test);         \
  } while (0)

#endif
