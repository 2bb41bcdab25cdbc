#include "tools/azimuth/interrupt.hpp"

#include <csignal>

#include "tools/azimuth/command.hpp"

namespace azimuth {
namespace {

volatile std::sig_atomic_t interrupted = 0;

void note(int /*signal*/) { interrupted = 1; }

constexpr int kSignals[] = {SIGINT, SIGTERM};

}  // namespace

Interruptible::Interruptible() {
  interrupted = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : kSignals) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN)
      ::sigaction(signal, &action, nullptr);  // nohup and background jobs ignore signals
  }
}

Interruptible::~Interruptible() {
  for (const int signal : kSignals) {
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    if (now.sa_handler == note) std::signal(signal, SIG_DFL);
  }
}

void Interruptible::check() {
  if (interrupted != 0) throw CommandError{kInterrupted, "interrupted: nothing was written"};
}

}  // namespace azimuth
