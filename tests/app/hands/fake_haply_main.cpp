// SPDX-License-Identifier: Apache-2.0
// The stand-in for Haply's service as a program, for those without a device: a hand that goes down into what is below
// it and draws along, over and over. usage: fake_haply [SECONDS [FAULT]]
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "app/hands/fake_haply.h"

namespace {

using incise::Vec3;
using incise::test::FakeHaply;

constexpr double kRound = 4;                        // s
constexpr double kDepth = 0.035, kWay = 0.03;       // m
constexpr double kFaultEvery = 2, kFaultFor = 0.3;  // s

/// Down, along, up, and back above.
Vec3 plan(double time) {
  const double at = std::fmod(time, kRound) / kRound;
  const auto ramp = [at](double from, double to) { return std::min(std::max((at - from) / (to - from), 0.0), 1.0); };
  return {kWay * (ramp(0.25, 0.6) - ramp(0.8, 1)), 0, -kDepth * (ramp(0, 0.25) - ramp(0.6, 0.8))};
}

FakeHaply::Fault fault_of(const char* name) {
  using Fault = FakeHaply::Fault;
  if (std::strcmp(name, "silence") == 0) return Fault::kSilence;
  if (std::strcmp(name, "json") == 0) return Fault::kBadJson;
  if (std::strcmp(name, "drop") == 0) return Fault::kDrop;
  return Fault::kNone;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 3 || (argc > 1 && std::atof(argv[1]) < 0)) {
    std::fprintf(stderr, "usage: fake_haply [SECONDS [silence|json|drop]]   (0: until it is ended)\n");
    return 2;
  }
  const double seconds = argc > 1 ? std::atof(argv[1]) : 0;
  const FakeHaply::Fault fault = argc > 2 ? fault_of(argv[2]) : FakeHaply::Fault::kNone;
  FakeHaply service(plan);
  std::printf("haply=127.0.0.1:%u\n", static_cast<unsigned>(service.port()));
  std::fflush(stdout);
  const auto start = std::chrono::steady_clock::now();
  double time = 0, next_fault = kFaultEvery;
  while (seconds == 0 || time < seconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (fault == FakeHaply::Fault::kNone || time < next_fault) continue;
    service.set_fault(fault);
    std::this_thread::sleep_for(std::chrono::duration<double>(kFaultFor));
    service.set_fault(FakeHaply::Fault::kNone);
    next_fault += kFaultEvery;
  }
  std::printf("%llu forces in %llu sessions, at most %.2f N\n", static_cast<unsigned long long>(service.forces()),
              static_cast<unsigned long long>(service.sessions()), service.strongest());
  return 0;
}
