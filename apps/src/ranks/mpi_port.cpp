// SPDX-License-Identifier: BSD-3-Clause
#include "mpi_port.hpp"

#include <mpi.h>

#include <string>

namespace hypermap::app {
namespace {

constexpr int kMessageTag = 1;

}  // namespace

Result<std::unique_ptr<MpiPort>> MpiPort::open() {
  int provided = MPI_THREAD_SINGLE;
  // Other threads work; they know nothing of MPI.
  if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS ||
      provided < MPI_THREAD_FUNNELED) {
    return fail(ErrorCode::kUnavailable, "MPI cannot be begun", "--ranks");
  }
  int rank = 0;
  int num_ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &num_ranks);
  return std::unique_ptr<MpiPort>(new MpiPort(rank, num_ranks));
}

MpiPort::~MpiPort() {
  MPI_Finalize();
}

void MpiPort::send(std::size_t to, std::string_view bytes) {
  MPI_Send(bytes.data(),
           static_cast<int>(bytes.size()),
           MPI_BYTE,
           static_cast<int>(to),
           kMessageTag,
           MPI_COMM_WORLD);
}

std::optional<RankMessage> MpiPort::poll() {
  int has_come = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, kMessageTag, MPI_COMM_WORLD, &has_come, &status);
  if (has_come == 0) return std::nullopt;
  int num_bytes = 0;
  MPI_Get_count(&status, MPI_BYTE, &num_bytes);
  RankMessage message{.from = static_cast<std::size_t>(status.MPI_SOURCE),
                      .bytes = std::string(static_cast<std::size_t>(num_bytes), '\0')};
  MPI_Recv(message.bytes.data(),
           num_bytes,
           MPI_BYTE,
           status.MPI_SOURCE,
           kMessageTag,
           MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return message;
}

}  // namespace hypermap::app
