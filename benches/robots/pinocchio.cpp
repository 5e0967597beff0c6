// The same by Pinocchio: ABA, and its analytical derivatives by configuration, rates and torques.
//
// With the wheel `pin` in a virtual environment, P being its site-packages/cmeel.prefix, and urdfdom's headers:
//   g++ -O3 -march=native -DNDEBUG -std=c++17 -DBOOST_MPL_LIMIT_LIST_SIZE=30 \
//       -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS -I$P/include -I$P/include/eigen3 pinocchio.cpp -o pinocchio \
//       -L$P/lib -Wl,-rpath,$P/lib -lpinocchio_parsers -lpinocchio_default -lboost_serialization
//   ./pinocchio ../../tests/data/robots/{ur5,panda,anymal,go2}.urdf
#include <pinocchio/fwd.hpp>

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/joint-configuration.hpp>
#include <pinocchio/parsers/urdf.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

using Clock = std::chrono::steady_clock;
constexpr int STATES = 64;

template <class Call> void tell(const char *what, const std::string &robot, Call call) {
  auto sample = [&](long count) {
    auto start = Clock::now();
    for (long i = 0; i < count; ++i) call(i % STATES);
    return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
  };
  long count = STATES;
  while (sample(count) < 1e5) count *= 2;
  std::vector<double> samples;
  auto start = Clock::now();
  while (Clock::now() - start < std::chrono::milliseconds(800)) samples.push_back(sample(count) / count);
  std::sort(samples.begin(), samples.end());
  std::printf("pinocchio_%s %s ns_min %.1f ns_median %.1f\n", what, robot.c_str(), samples[0],
              samples[samples.size() / 2]);
}

int main(int count, char **paths) {
  for (int at = 1; at < count; ++at) {
    pinocchio::Model model;
    pinocchio::urdf::buildModel(paths[at], pinocchio::JointModelFreeFlyer(), model);
    model.gravity.setZero();
    pinocchio::Data data(model);
    std::vector<Eigen::VectorXd> q, v, tau;
    for (int i = 0; i < STATES; ++i) {
      auto of = [&](double phase) {
        Eigen::VectorXd all(model.nv);
        for (int j = 0; j < model.nv; ++j) all[j] = 1.5 * std::sin(1.7 * i + 0.9 * j + phase);
        return all;
      };
      q.push_back(pinocchio::integrate(model, pinocchio::neutral(model), of(0.0)));
      v.push_back(of(1.0));
      tau.push_back(of(2.0));
    }
    const std::string robot = std::filesystem::path(paths[at]).stem();
    tell("accelerations", robot, [&](int i) { pinocchio::aba(model, data, q[i], v[i], tau[i]); });
    tell("derivatives", robot,
         [&](int i) { pinocchio::computeABADerivatives(model, data, q[i], v[i], tau[i]); });
  }
}
