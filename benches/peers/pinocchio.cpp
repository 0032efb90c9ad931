// Pinocchio's inner loops, timed: pinocchio MODEL STATES PASSES
//
// MODEL is a model as Pinocchio's saveToText writes it, with a frame `tool0`. STATES is text: the number of
// states and of hinges n, then per state q, v, a and torque (4 n numbers).
// Prints one JSON object: microseconds per call, the fastest of PASSES rounds over all states.
// Built and run by beside_pinocchio.py, beside ident in one run.
#include <pinocchio/multibody.hpp>
#include <pinocchio/serialization.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

namespace pin = pinocchio;
using Eigen::VectorXd;

struct State { VectorXd q, v, a, torque; };

static std::vector<State> read_states(const std::string & path) {
  std::ifstream file(path);
  int count = 0, n = 0;
  file >> count >> n;
  std::vector<State> states(count);
  for (State & s : states)
    for (VectorXd * x : {&s.q, &s.v, &s.a, &s.torque}) {
      x->resize(n);
      for (int i = 0; i < n; ++i) file >> (*x)[i];
    }
  if (!file || states.empty()) { std::cerr << path << ": no states\n"; std::exit(2); }
  return states;
}

// Per call, in the fastest of `passes` rounds over all states: short rounds escape other programs.
template<typename Work>
static double microseconds(const std::vector<State> & states, int passes, Work && work) {
  double sum = 0, best = 1e300;
  for (int k = 0; k < passes; ++k) {
    const auto start = std::chrono::steady_clock::now();
    for (const State & s : states) sum += work(s);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count() / states.size());
  }
  if (sum != sum) std::cerr << "not a number\n";  // the result is used
  return best;
}

int main(int argc, char ** argv) {
  if (argc != 4) { std::cerr << "usage: pinocchio MODEL STATES PASSES\n"; return 2; }
  pin::Model model;
  model.loadFromText(argv[1]);
  const std::vector<State> states = read_states(argv[2]);
  const int passes = std::atoi(argv[3]);
  pin::Data data(model);
  const pin::FrameIndex tool = model.getFrameId("tool0");

  const double aba_local = microseconds(states, passes, [&](const State & s) {
    return pin::aba(model, data, s.q, s.v, s.torque, pin::Convention::LOCAL)[0];
  });
  const double aba_world = microseconds(states, passes, [&](const State & s) {
    return pin::aba(model, data, s.q, s.v, s.torque, pin::Convention::WORLD)[0];
  });
  Eigen::LLT<Eigen::MatrixXd, Eigen::Upper> llt(model.nv);
  VectorXd rest(model.nv);
  const double factor = microseconds(states, passes, [&](const State & s) {
    pin::crba(model, data, s.q);
    rest = s.torque - pin::nonLinearEffects(model, data, s.q, s.v);
    llt.compute(data.M);
    llt.solveInPlace(rest);
    return rest[0];
  });
  const double rnea = microseconds(states, passes, [&](const State & s) {
    return pin::rnea(model, data, s.q, s.v, s.a)[0];
  });
  const double crba = microseconds(states, passes, [&](const State & s) {
    return pin::crba(model, data, s.q)(0, 0);
  });
  // C = sum over the hinges of J_v J_v' / k at the tool, stiffness k as in beside.rs
  pin::Data::Matrix6x jacobian = pin::Data::Matrix6x::Zero(6, model.nv);
  VectorXd soft(model.nv);
  for (int i = 0; i < model.nv; ++i) soft[i] = 1.0 / (1e6 * (1.0 + i));
  Eigen::Matrix3d c;
  const double compliance = microseconds(states, passes, [&](const State & s) {
    pin::computeJointJacobians(model, data, s.q);
    jacobian.setZero();
    pin::getFrameJacobian(model, data, tool, pin::LOCAL_WORLD_ALIGNED, jacobian);
    const auto v = jacobian.topRows<3>();
    c.noalias() = v.lazyProduct(soft.asDiagonal() * v.transpose());
    return c(0, 0) + c(2, 1);
  });
  std::cout << "{\"forward dynamics, ABA local\": " << aba_local
            << ", \"forward dynamics, ABA world\": " << aba_world
            << ", \"forward dynamics, CRBA + Cholesky\": " << factor
            << ", \"RNEA\": " << rnea << ", \"CRBA\": " << crba
            << ", \"compliance\": " << compliance << "}\n";
}
