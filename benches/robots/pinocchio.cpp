// The same by Pinocchio: articulated bodies, and with analytical derivatives by configuration, rates and torques.
//
// With the programs beside which robots are measured set up in the folder PEERS, and P its
// venv/lib/python3.11/site-packages/cmeel.prefix:
//   g++ -O3 -march=native -DNDEBUG -std=c++17 -DBOOST_MPL_LIMIT_LIST_SIZE=30 \
//       -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS -I$PEERS -I$P/include -I$P/include/eigen3 pinocchio.cpp \
//       -o pinocchio -L$P/lib -Wl,-rpath,$P/lib -lpinocchio_default -lboost_serialization
//   ./pinocchio $PEERS/models ur5 panda anymal go2
#include "pin_build.hpp"

#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/aba.hpp>

int main(int count, char **words) {
  for (int at = 2; at < count; ++at) {
    const Model robot = load(words[1], words[at]);
    const auto model = build_pin(robot);
    pinocchio::Data data(model);
    std::vector<Eigen::VectorXd> q, v, tau;
    for (int i = 0; i < robot.ns; ++i) {
      q.push_back(Eigen::Map<const Eigen::VectorXd>(robot.q[i].data(), robot.nq));
      v.push_back(Eigen::Map<const Eigen::VectorXd>(robot.v[i].data(), robot.nv));
      tau.push_back(Eigen::Map<const Eigen::VectorXd>(robot.tau[i].data(), robot.nv));
    }
    using pinocchio::Convention;
    for (auto [what, convention] : {std::pair{"pinocchio_accelerations_local", Convention::LOCAL},
                                    std::pair{"pinocchio_accelerations_world", Convention::WORLD}})
      bench(what, robot, [&, by = convention](int i) { pinocchio::aba(model, data, q[i], v[i], tau[i], by); });
    bench("pinocchio_derivatives", robot,
          [&](int i) { pinocchio::computeABADerivatives(model, data, q[i], v[i], tau[i]); });
  }
}
