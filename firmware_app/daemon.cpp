#include "firmware_app/daemon.hpp"

#include <pthread.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <utility>

#include "drivers/files/atomic_file.hpp"
#include "drivers/system/clock.hpp"
#include "drivers/system/log.hpp"
#include "drivers/system/memory_lock.hpp"
#include "drivers/system/progress_watch.hpp"
#include "drivers/system/service_notifier.hpp"
#include "drivers/system/signals.hpp"
#include "firmware_app/frame_sources.hpp"
#include "firmware_app/loaded_banks.hpp"
#include "firmware_app/memory_block.hpp"
#include "firmware_app/memory_plan.hpp"
#include "firmware_app/pick_worker.hpp"
#include "firmware_app/plc_links.hpp"

namespace graspd {
namespace {

/// Everything that is loaded and allocated before the first trigger.
struct Equipment {
  LoadedBanks banks;
  OpenedSource frames;
  MemoryPlan plan;
  MemoryBlock block;
  PickCycle cycle;
};

Status limit_thread_stacks() {
  pthread_attr_t attributes;
  int problem = pthread_attr_init(&attributes);
  if (problem == 0) problem = pthread_attr_setstacksize(&attributes, thread_stack_bytes);
  if (problem == 0) problem = pthread_setattr_default_np(&attributes);
  if (problem == 0) return {};
  return {StatusCode::internal, "the size of thread stacks cannot be set"};
}

PickSettings pick_settings(const Configuration& configuration) {
  PickSettings settings;
  settings.detect = configuration.detect.parameters;
  settings.grasp = configuration.grasp.parameters;
  settings.count_all = configuration.grasp.count_all;
  settings.regions = configuration.regions;
  settings.calibrated = configuration.calibrated || configuration.camera_on_flange;
  settings.camera_on_flange = configuration.camera_on_flange;
  settings.flange_from_camera = configuration.flange_from_camera;
  settings.robot_from_box = configuration.detect.robot_from_box;
  settings.keeps_snapshots = !configuration.snapshots.empty();
  settings.minimum_score = configuration.detect.minimum_score;
  settings.deadline_ns = configuration.detect.deadline_ns;
  settings.maximum_age_ns = static_cast<std::int64_t>(static_cast<double>(configuration.camera.maximum_age) * 1e9);
  settings.now_ns = &monotonic_ns;
  return settings;
}

/// The pick worker stands still while it waits for a frame, and systemd must not take that for a fault.
Status check_watchdog(const CameraSettings& camera, std::int64_t watchdog_interval_ns) {
  const std::int64_t timeout_ns = camera.genicam.timeout_ns;
  if (camera.kind != CameraKind::genicam || watchdog_interval_ns == 0) return {};
  if (timeout_ns <= watchdog_interval_ns / 2) return {};
  return Status::format(StatusCode::bad_configuration,
                        "camera.timeout is %.1f s, but the service's WatchdogSec %.1f s: systemd would restart graspd "
                        "while it waits for a frame; shorten the timeout to half of WatchdogSec, or raise that",
                        static_cast<double>(timeout_ns) * 1e-9, static_cast<double>(watchdog_interval_ns) * 1e-9);
}

Status equip(const Configuration& configuration, Equipment& equipment) {
  const std::size_t baseline = resident_bytes();
  Result<LoadedBanks> banks = load_banks(configuration.banks);
  if (!banks.ok()) return banks.status();
  equipment.banks = std::move(banks).value();
  Result<OpenedSource> frames = open_source(configuration.camera, true);
  if (!frames.ok()) return frames.status();
  equipment.frames = std::move(frames).value();
  if (!configuration.picture.empty()) {
    if (Status writable = check_writable(configuration.picture); !writable.ok()) return writable;
  }
  if (!configuration.snapshots.empty()) {
    if (Status ready = prepare_snapshots(configuration.snapshots); !ready.ok()) return ready;
  }
  equipment.plan =
      plan_memory(configuration, equipment.banks, equipment.frames.source->limits(), equipment.frames.bytes, baseline);
  if (Status fits = check_budget(configuration, equipment.plan); !fits.ok()) return fits;
  equipment.block = MemoryBlock(equipment.plan.arena_bytes);
  Arena arena(equipment.block.bytes());
  equipment.cycle.settings = pick_settings(configuration);
  equipment.cycle.banks = equipment.banks.banks;
  equipment.cycle.source = equipment.frames.source.get();
  equipment.cycle.memory = carve_working_memory(arena, equipment.plan.capacity);
  return {};
}

/// Watches workers and signals until somebody asks to stop.
void supervise(SignalWaiter& signals, ServiceNotifier& notifier, const PickWorker& worker, const PlcLink& plc) {
  constexpr std::array<const char*, 2> names{"pick worker", "Modbus link"};
  const std::int64_t interval_ms = notifier.watchdog_interval_ns() / 1'000'000;
  const std::chrono::milliseconds period(interval_ms == 0 ? 1000 : std::clamp<std::int64_t>(interval_ms / 4, 10, 1000));
  ProgressWatch watch;
  std::int64_t moved_ns = monotonic_ns();
  bool told = false;
  while (true) {
    const Signal signal = signals.wait(period);
    if (signal == Signal::stop) return;
    if (signal == Signal::reload) {
      log_event(LogLevel::notice, "N005", "SIGHUP ignored: restart the service to read the configuration again");
    }
    const std::int64_t now = monotonic_ns();
    const std::array<std::uint64_t, 2> counters{worker.progress_count(), plc.progress_count()};
    if (watch.all_moved(counters)) {
      notifier.watchdog();
      moved_ns = now;
      told = false;
    } else if (!told && interval_ms > 0 && now - moved_ns > notifier.watchdog_interval_ns() / 2) {
      log_event(LogLevel::warning, "W006", "no progress for %.1f s: %s", static_cast<double>(now - moved_ns) * 1e-9,
                names[std::min(watch.first_stuck(), names.size() - 1)]);
      told = true;
    }
  }
}

}  // namespace

Status run_daemon(const Configuration& configuration) {
  Result<SignalWaiter> signals = SignalWaiter::make();
  if (!signals.ok()) return signals.status();
  ServiceNotifier notifier;
  if (Status fits = check_watchdog(configuration.camera, notifier.watchdog_interval_ns()); !fits.ok()) return fits;
  Equipment equipment;
  if (Status limited = limit_thread_stacks(); !limited.ok()) return limited;
  if (Status equipped = equip(configuration, equipment); !equipped.ok()) return equipped;
  Result<OpenedLink> opened = open_plc_link(configuration);
  if (!opened.ok()) return opened.status();
  PlcLink& plc = *opened.value().link;
  if (configuration.memory_lock) {
    if (Status locked = lock_memory(); !locked.ok()) return locked;
  }

  std::unique_ptr<PictureWriter> pictures;
  if (!configuration.picture.empty()) {
    pictures =
        std::make_unique<PictureWriter>(configuration.picture, equipment.cycle.memory, configuration.grasp.parameters);
  }
  std::unique_ptr<SnapshotWriter> snapshots;
  if (!configuration.snapshots.empty()) {
    snapshots = std::make_unique<SnapshotWriter>(configuration.snapshots,
                                                 static_cast<std::size_t>(configuration.snapshots_kept),
                                                 equipment.cycle.memory.snapshot_frame);
  }
  std::unique_ptr<RecordWriter> records;
  if (!configuration.record.folder.empty()) {
    Result<RecordFolder> folder = RecordFolder::open(configuration.record);
    if (!folder.ok()) return folder.status();
    const WorkingCapacity& capacity = equipment.plan.capacity;
    records = std::make_unique<RecordWriter>(std::move(folder).value(), configuration.record.when, configuration.path,
                                             equipment.banks, capacity.frame_pixels, recorded_instances(capacity));
  }
  PickWorker worker(equipment.cycle, plc, {pictures.get(), snapshots.get(), records.get()});
  if (Status ready = worker.wait_ready(); !ready.ok()) return ready;
  notifier.ready();
  const OpenedLink& link = opened.value();
  notifier.status("%s %s port %u", link.role, link.address.c_str(), unsigned{link.port});
  log_event(LogLevel::notice, "N001", "ready, %s address=%s port=%u banks=%zu memory_mib=%.0f budget_mib=%.0f",
            link.role, link.address.c_str(), unsigned{link.port}, equipment.banks.banks.size(),
            static_cast<double>(equipment.plan.total()) / 1048576.0,
            static_cast<double>(configuration.memory_budget) / 1048576.0);
  supervise(signals.value(), notifier, worker, plc);

  notifier.stopping();
  plc.stop();
  worker.stop();
  log_event(LogLevel::notice, "N002", "stopped");
  return {};
}

}  // namespace graspd
