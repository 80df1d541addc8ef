/* The least that a test needs: a claim, a line for what was shown, a count of what was not. */
#ifndef MUSLIN_CHECK_H
#define MUSLIN_CHECK_H

#include <muslin.h>
#include <stdio.h>
#include <string.h>

static int failures = 0;

/* Claims something; a false claim is told and counted. */
#define CHECK(claim)                                                                      \
  do {                                                                                    \
    if (!(claim)) {                                                                       \
      failures++;                                                                         \
      fprintf(stderr, "%s:%d: not so: %s (last error: %s)\n", __FILE__, __LINE__, #claim, \
              muslin_last_error());                                                       \
    }                                                                                     \
  } while (0)

/* Claims that a call is done. */
#define DONE(call) CHECK((call) == MUSLIN_STATUS_OK)

/* Claims that a call is refused with a status, in words that say something. */
#define REFUSED(call, status, words)                        \
  do {                                                      \
    CHECK((call) == (status));                              \
    CHECK(strstr(muslin_last_error(), (words)) != NULL);    \
  } while (0)

/* Runs a test and prints its line. */
#define TEST(test)                                                          \
  do {                                                                      \
    int before = failures;                                                  \
    test();                                                                 \
    printf("%s %s\n", failures == before ? "  ok" : "FAIL", #test);         \
  } while (0)

#endif
