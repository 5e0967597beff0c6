// The smooth problem of T1 by MuJoCo, one trajectory after the other: Runge and Kutta's method of order four, its most
// exact one, at some step lengths. Prints a line for each: microseconds of a trajectory, and the largest difference of
// the attitude and the hinge angles at the end from the reference, over the largest of them.
//
//   g++ -std=c++17 -O3 -march=native -I$MUJOCO/include mujoco.cpp $MUJOCO/libmujoco.so.* -Wl,-rpath,$MUJOCO -o mujoco
//   ./mujoco $PEERS/models
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

int main(int, char **arguments) {
    const std::string models = arguments[1];
    char error[1000];
    mjModel *model = mj_loadXML((models + "/T1.xml").c_str(), nullptr, error, sizeof error);
    if (!model) return std::printf("%s\n", error), 1;
    // Attitude, vector first, and angles of the hinges.
    double expected[8];
    std::ifstream reference(models + "/T1_smooth_ref.txt");
    for (double &number : expected) reference >> number;

    const double degree = std::acos(-1.0) / 180.0;
    const double stiffness[] = {4, 1, 4, 4}, start[] = {90, 170, 5, 90}, rest[] = {0, 0, 90, 0};
    for (int hinge = 0; hinge < 4; ++hinge) {
        const int joint = hinge + 1;
        model->jnt_stiffness[joint] = stiffness[hinge];
        model->qpos_spring[model->jnt_qposadr[joint]] = rest[hinge] * degree;
        model->dof_damping[model->jnt_dofadr[joint]] = 1e-3;
    }
    model->opt.disableflags &= ~(mjDSBL_SPRING | mjDSBL_DAMPER);
    model->opt.integrator = mjINT_RK4;
    mju_zero3(model->opt.gravity);
    mjData *data = mj_makeData(model);
    for (int steps : {50, 100, 200, 400, 800, 1600, 3200}) {
        model->opt.timestep = 1.0 / steps;
        double shortest = 1e300, off = 0, largest = 0;
        for (int repeat = 0; repeat < 30; ++repeat) {
            mj_resetData(model, data);
            mju_zero(data->qpos, model->nq);
            data->qpos[3] = 1;
            data->qvel[3] = 10;
            for (int hinge = 0; hinge < 4; ++hinge) data->qpos[7 + hinge] = start[hinge] * degree;
            const auto before = std::chrono::steady_clock::now();
            for (int step = 0; step < steps; ++step) mj_step(model, data);
            const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
            shortest = std::min(shortest, took.count());
        }
        const double *q = data->qpos;
        const double found[] = {q[4], q[5], q[6], q[3], q[7], q[8], q[9], q[10]};
        const double sign = expected[3] * q[3] < 0 ? -1 : 1;
        for (int i = 0; i < 8; ++i) {
            off = std::max(off, std::fabs((i < 4 ? sign : 1) * found[i] - expected[i]));
            largest = std::max(largest, std::fabs(expected[i]));
        }
        std::printf("mujoco rk4 steps %d us_per_traj_min %.1f poserr %.2e relerr %.2e\n", steps, shortest, off, off / largest);
    }
}
