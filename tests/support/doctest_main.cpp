/// @file
/// doctest's main. A run that evaluates no assertion, because every case was skipped or returned early for
/// want of data, ends with exit code 77, which ctest reports as skipped: a test that checks nothing must not
/// look passed.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

namespace {

constexpr int skipped_exit_code = 77;
int assertions = 0;

struct assertion_counter : doctest::IReporter {
  explicit assertion_counter(const doctest::ContextOptions&) {}

  void test_run_end(const doctest::TestRunStats& stats) override { assertions = stats.numAsserts; }

  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_case_start(const doctest::TestCaseData&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}
};

REGISTER_LISTENER("assertion_counter", 1, assertion_counter);

} // namespace

int main(int argc, char** argv) {
  doctest::Context context(argc, argv);
  const int result = context.run();
  if (context.shouldExit())
    return result;
  return result == 0 && assertions == 0 ? skipped_exit_code : result;
}
