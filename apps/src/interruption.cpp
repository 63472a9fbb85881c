// SPDX-License-Identifier: BSD-3-Clause
#include "interruption.hpp"

#include <csignal>
#include <initializer_list>

namespace hypermap::app {
namespace {

// A handler has no other way to leave word.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
volatile std::sig_atomic_t noted_signal = 0;

extern "C" void note_signal(int signal) {
  noted_signal = signal;
}

}  // namespace

void watch_interruptions() {
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
}

int interrupting_signal() {
  return noted_signal;
}

void forget_interruption() {
  noted_signal = 0;
  watch_interruptions();  // a signal that came is watched no more
}

}  // namespace hypermap::app
