// Whatever an engine meets, want of memory or of time, a verdict stays the same
// or is not given.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <map>
#include <new>
#include <string>

#include "smt/verify.h"
#include "source.h"

namespace {

/// Allocations until one fails, and how often it does then.
std::atomic<std::int64_t> allocations_left = -1;
std::atomic<std::int64_t> allocations = 0;

void* allocate(std::size_t size) {
  allocations.fetch_add(1, std::memory_order_relaxed);
  if (allocations_left.load(std::memory_order_relaxed) >= 0 &&
      allocations_left.fetch_sub(1, std::memory_order_relaxed) == 0) {
    throw std::bad_alloc();
  }
  void* memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size); }
void* operator new[](std::size_t size) { return allocate(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace rung {
namespace {

constexpr const char* kPlant =
    "//@ lock: interlock Q0, Q1\n"
    "//@ wrong: never Q0 && I1\n"
    "//@ late: never Q2 && !Q0\n"
    "//@ early: always Q0 -> Q2\n"
    "//@ soon: after I0 && !I2 && !Q1, Q0 within 1 scans\n"
    "//@ back: recoverable !Q0\n"
    "//@ stuck: recoverable Q3 && !I3\n"
    "//@ count: never C(0).value > 3\n"
    "Q0 = (I0 || Q0) && !I2 && !Q1;\n"
    "Q1 = (I1 || Q1) && !I2 && !Q0;\n"
    "Q2 = T(0, 500, Q0);\n"
    "Q3 = (I3 || Q3) && !Q4; Q4 = Q3 || Q4;\n"
    "Q5 = C(0, 3, I4, 0, I5);\n";

class Starved : public testing::Test {
 protected:
  Starved() { right_ = verdicts({}); }

  std::map<std::string, Verdict> verdicts(const VerifyOptions& options) {
    const VerifyReport report =
        verify(plant_.program, plant_.properties, options);
    EXPECT_TRUE(report.failures.empty());
    for (const SelfCheckFailure& failure : report.failures) {
      ADD_FAILURE() << failure.obligation << ": " << failure.what;
    }
    std::map<std::string, Verdict> result;
    for (const ObligationResult& one : report.results) {
      result.emplace(one.obligation.name, one.verdict);
    }
    return result;
  }

  /// How many were not given.
  int compare(const std::map<std::string, Verdict>& given) {
    int open = 0;
    EXPECT_EQ(given.size(), right_.size());
    for (const auto& [name, verdict] : given) {
      if (verdict == Verdict::Unknown || verdict == Verdict::Bounded) {
        ++open;
      } else {
        EXPECT_EQ(verdict, right_.at(name)) << name;
      }
    }
    return open;
  }

  const Source plant_{kPlant};
  std::map<std::string, Verdict> right_;
};

TEST_F(Starved, EverythingIsDecidedWithoutWant) {
  EXPECT_EQ(compare(right_), 0);
  EXPECT_EQ(right_.at("lock"), Verdict::Proved);
  EXPECT_EQ(right_.at("wrong"), Verdict::Violated);
  EXPECT_EQ(right_.at("early"), Verdict::Violated);
  EXPECT_EQ(right_.at("stuck"), Verdict::Violated);
}

/// One allocation fails, wherever it is: in the encoding, a solver, a check.
TEST_F(Starved, OfMemoryOnce) {
  allocations = 0;
  verdicts({});
  const std::int64_t all = allocations;
  int given_up = 0;
  int thrown = 0;
  constexpr std::int64_t kRuns = 200;
  for (std::int64_t run = 0; run < kRuns; ++run) {
    allocations_left = all * run / kRuns + run % 7;
    try {
      given_up += compare(verdicts({}));
    } catch (const std::bad_alloc&) {
      ++thrown;  // before there was anything to decide
    }
    allocations_left = -1;
  }
  EXPECT_GT(given_up, 0);
  EXPECT_LT(thrown, kRuns / 4);
}

rlim_t used_addresses() {
  std::ifstream pages("/proc/self/statm");
  rlim_t count = 0;
  pages >> count;
  return count * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// Of all memory beyond some, Z3's included: in a process of its own, which
/// must end by itself.
TEST_F(Starved, OfMemoryForGood) {
  VerifyOptions options;
  options.recheck = "z3";
  int done = 0;
  for (rlim_t megabytes = 0; megabytes <= 128; megabytes += 4) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const rlim_t most = used_addresses() + (megabytes << 20U);
      const rlimit limit = {most, most};
      int status = 1;
      try {
        setrlimit(RLIMIT_AS, &limit);
        status = compare(verdicts(options)) == 0 ? 0 : 3;
        if (HasFailure()) status = 1;
      } catch (const std::bad_alloc&) {
        status = 3;
      }
      _exit(status);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status)) << megabytes << " MB";
    EXPECT_NE(WEXITSTATUS(status), 1) << megabytes << " MB";
    done += WEXITSTATUS(status) == 0 ? 1 : 0;
  }
  EXPECT_GT(done, 0);
}

TEST_F(Starved, OfTime) {
  for (int run = 0; run < 20; ++run) {
    VerifyOptions options;
    options.budget.seconds = 0.0005 * run * run;
    compare(verdicts(options));
  }
}

TEST_F(Starved, OfAllEnginesButOne) {
  for (const EngineInfo& engine : engines()) {
    VerifyOptions options;
    options.engine = engine.name;
    compare(verdicts(options));
  }
}

}  // namespace
}  // namespace rung
