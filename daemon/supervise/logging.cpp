#include "daemon/supervise/logging.hpp"

#include <cstdlib>
#include <memory>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/sinks/systemd_sink.h>
#include <spdlog/spdlog.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "base/visible.hpp"
#include "daemon/journal/journal.hpp"

namespace azimuth {
namespace {

/// True: standard error is the stream that systemd connected to the journal (systemd.exec(5), JOURNAL_STREAM). The
/// variable alone is not sufficient, because a shell may have inherited it.
bool logs_to_journal() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): before the first thread starts
  const char* const stream = std::getenv("JOURNAL_STREAM");
  struct stat error {};
  if (!stream || fstat(STDERR_FILENO, &error) != 0) return false;
  return stream == std::to_string(error.st_dev) + ":" + std::to_string(error.st_ino);
}

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      break;
  }
  return spdlog::level::err;
}

/// Prints a message with all control characters made visible, because the names of devices, robots and peers appear in
/// it.
class VisibleMessage : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm& /*time*/, spdlog::memory_buf_t& out) override {
    const std::string text = visible(std::string_view(message.payload.data(), message.payload.size()));
    out.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override { return std::make_unique<VisibleMessage>(); }
};

std::unique_ptr<spdlog::formatter> formatter_of(const char* pattern) {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<VisibleMessage>('*').set_pattern(pattern);
  return formatter;
}

}  // namespace

void set_up_logging(LogLevel level) {
  spdlog::sink_ptr sink;
  const bool to_journal = logs_to_journal();
  log_to_journal(to_journal);
  if (to_journal) {
    sink = std::make_shared<spdlog::sinks::systemd_sink_mt>("azimuthd");
    sink->set_formatter(formatter_of("%*"));  // the journal adds time and severity
  } else {
    sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>();
    sink->set_formatter(formatter_of("%Y-%m-%d %H:%M:%S.%e %^%l%$ %*"));
  }
  auto logger = std::make_shared<spdlog::logger>("azimuthd", std::move(sink));
  logger->set_level(level_of(level));
  spdlog::set_default_logger(std::move(logger));
}

}  // namespace azimuth
