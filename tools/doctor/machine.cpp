#include "tools/doctor/machine.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <grp.h>
#include <iterator>
#include <limits>
#include <memory>
#include <pwd.h>
#include <sstream>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/timex.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/doctor/bounded_answer.hpp"

namespace azimuth {

namespace fs = std::filesystem;

namespace {

std::vector<gid_t> groups_of(const passwd& user) {
  int count = 64;
  std::vector<gid_t> groups(static_cast<std::size_t>(count));
  if (::getgrouplist(user.pw_name, user.pw_gid, groups.data(), &count) < 0) {
    groups.resize(static_cast<std::size_t>(count));
    ::getgrouplist(user.pw_name, user.pw_gid, groups.data(), &count);
  }
  groups.resize(static_cast<std::size_t>(std::max(count, 0)));
  return groups;
}

std::vector<gid_t> own_groups() {
  std::vector<gid_t> groups(static_cast<std::size_t>(std::max(::getgroups(0, nullptr), 0)));
  ::getgroups(static_cast<int>(groups.size()), groups.data());
  groups.push_back(::getegid());
  return groups;
}

std::optional<std::uint64_t> limit(__rlimit_resource resource) {
  rlimit value{};
  if (::getrlimit(resource, &value) != 0) return std::nullopt;
  return value.rlim_cur == RLIM_INFINITY ? std::numeric_limits<std::uint64_t>::max() : value.rlim_cur;
}

std::optional<bool> kernel_clock_synchronised() {
  timex state{};
  if (::adjtimex(&state) < 0) return std::nullopt;
  return (state.status & STA_UNSYNC) == 0;
}

std::optional<std::uint64_t> free_on_disk(const fs::path& folder) {
  struct statvfs disk {};
  if (::statvfs(folder.c_str(), &disk) != 0) return std::nullopt;
  return std::uint64_t{disk.f_bavail} * disk.f_frsize;
}

/// Quotes a word for the shell. Between single quotes, only the single quote itself is special.
std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + '\'';
}

std::optional<ProgramOutcome> run_program(const std::vector<std::string>& command) {
  constexpr int kNotFound = 127;
  std::string line;
  for (const std::string& word : command) line += quoted(word) + ' ';
  std::FILE* const pipe = ::popen((line + "2>&1 </dev/null").c_str(), "re");
  if (pipe == nullptr) return std::nullopt;
  ProgramOutcome outcome;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) outcome.output.push_back(static_cast<char>(c));
  const int status = ::pclose(pipe);
  if (!WIFEXITED(status) || WEXITSTATUS(status) == kNotFound) return std::nullopt;
  outcome.exit_code = WEXITSTATUS(status);
  return outcome;
}

/// Lists IIDC cameras with a time limit, since libdc1394 waits about a second per request for devices that do not
/// answer.
std::optional<IidcBus> answering_iidc_cameras() {
  constexpr std::chrono::seconds kPatience{5};
  const auto answer = answer_within(kPatience, [] {
    IidcBus bus = list_iidc_cameras();
    std::ranges::replace(bus.trouble, '\n', ' ');
    std::string lines = bus.trouble;
    for (const std::string& guid : bus.guids) lines += '\n' + guid;
    return lines;
  });
  if (!answer) return std::nullopt;
  IidcBus bus;
  std::istringstream lines(*answer);
  std::getline(lines, bus.trouble);
  for (std::string guid; std::getline(lines, guid);) bus.guids.push_back(guid);
  return bus;
}

/// A line of /etc/group: name:password:number:members.
struct Group {
  std::string name;
  gid_t id = 0;
};

std::vector<Group> groups_in(const Machine& machine) {
  std::vector<Group> groups;
  std::istringstream lines(file_content(machine.at("/etc/group")).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string name, password, number;
    std::getline(fields, name, ':');
    std::getline(fields, password, ':');
    std::getline(fields, number, ':');
    Group group{name, 0};
    if (std::from_chars(number.data(), number.data() + number.size(), group.id).ec == std::errc{})
      groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

fs::path Machine::at(std::string_view path) const {
  path.remove_prefix(std::min(path.find_first_not_of('/'), path.size()));
  return root / path;
}

std::optional<Machine> this_machine(const std::string& user) {
  const passwd* const entry = user.empty() ? ::getpwuid(::geteuid()) : ::getpwnam(user.c_str());
  if (entry == nullptr) return std::nullopt;
  Machine machine;
  machine.account = {entry->pw_name, entry->pw_uid, groups_of(*entry), {}, entry->pw_uid == ::geteuid()};
  const bool is_own = machine.account.is_here;
  machine.account.groups_here = is_own ? own_groups() : machine.account.groups;
  if (is_own) {
    machine.rtprio_limit = limit(RLIMIT_RTPRIO);
    machine.memlock_limit_bytes = limit(RLIMIT_MEMLOCK);
  }
  machine.clock_synchronised = kernel_clock_synchronised();
  machine.free_bytes = free_on_disk;
  machine.run = run_program;
  machine.video_nodes = [] { return v4l2::video_nodes(v4l2::kernel_calls()); };
  machine.iidc_cameras = answering_iidc_cameras;
  return machine;
}

std::optional<std::string> file_content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::string content{std::istreambuf_iterator<char>(stream), {}};
  if (stream.bad()) return std::nullopt;
  return content;
}

std::optional<std::string> first_line(const fs::path& file) {
  const std::optional<std::string> content = file_content(file);
  if (!content) return std::nullopt;
  return content->substr(0, content->find('\n'));
}

std::optional<std::int64_t> number_in(const fs::path& file, int base) {
  const std::optional<std::string> line = first_line(file);
  if (!line) return std::nullopt;
  std::string_view digits = *line;
  digits.remove_prefix(std::min(digits.find_first_not_of(' '), digits.size()));  // lock files pad numbers with blanks
  if (base == 16 && digits.starts_with("0x")) digits.remove_prefix(2);
  std::int64_t number = 0;
  if (std::from_chars(digits.data(), digits.data() + digits.size(), number, base).ec != std::errc{})
    return std::nullopt;
  return number;
}

std::vector<fs::path> entries(const fs::path& folder, std::string_view prefix) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename().string().starts_with(prefix)) found.push_back(entry->path());
  }
  std::ranges::sort(found, [](const fs::path& a, const fs::path& b) {
    const std::string x = a.string(), y = b.string();
    return x.size() != y.size() ? x.size() < y.size() : x < y;  // ttyUSB2 before ttyUSB10
  });
  return found;
}

std::string group_name(const Machine& machine, gid_t id) {
  for (const Group& group : groups_in(machine)) {
    if (group.id == id) return group.name;
  }
  return std::to_string(id);
}

std::optional<gid_t> group_id(const Machine& machine, std::string_view name) {
  for (const Group& group : groups_in(machine)) {
    if (group.name == name) return group.id;
  }
  return std::nullopt;
}

}  // namespace azimuth
