// SPDX-License-Identifier: Apache-2.0
// MuJoCo as a solver for others: reads lines of JSON, answers each with one.
//   {"points": [[x,y,z],...], "tets": [[a,b,c,d],...], "held": [i,...], "mass": kg, "young": Pa, "poisson": 1, "seconds": s}
//       compiles a soft body (a flex) at rest in `points`, with steps of `seconds`.
//   {"positions": [[x,y,z],...], "velocities": [[x,y,z],...], "steps": n}
//       puts the body there, goes on, and answers with where it is then: {"positions", "velocities"}.
import loadMujoco from '@mujoco/mujoco';
import readline from 'node:readline';

const mujoco = await loadMujoco();
let body = null;

function xml(b) {
  const list = (rows) => rows.map((row) => row.join(' ')).join(' ');
  return `<mujoco>
    <option timestep="${b.seconds}" integrator="discrete" gravity="0 0 -9.81"/>
    <worldbody>
      <flexcomp name="body" type="direct" dim="3" mass="${b.mass}" radius="0.001"
                point="${list(b.points)}" element="${list(b.tets)}">
        <contact contype="0" conaffinity="0" internal="false" selfcollide="none"/>
        <elasticity young="${b.young}" poisson="${b.poisson}" damping="${b.damping}"/>
        ${b.held.length ? `<pin id="${b.held.join(' ')}"/>` : ''}
      </flexcomp>
    </worldbody></mujoco>`;
}

/// Topology is compiled in: another one is another model. What moved is carried over by whoever asks.
function compile(request) {
  if (body) {
    body.data.delete();
    body.model.delete();
  }
  const model = mujoco.MjModel.from_xml_string(xml(request));
  const held = new Set(request.held);
  // Each free point has a body of three slides, whose coordinates are its way from its place at rest.
  const free = request.points.map((_, i) => i).filter((i) => !held.has(i));
  if (model.nv !== 3 * free.length) throw new Error(`${model.nv} degrees of freedom for ${free.length} free points`);
  body = { model, data: new mujoco.MjData(model), rest: request.points, free };
  return { points: request.points.length, freedoms: model.nv };
}

function advance(request) {
  const { model, data, rest, free } = body;
  free.forEach((point, k) => {
    for (let axis = 0; axis < 3; ++axis) {
      data.qpos[3 * k + axis] = request.positions[point][axis] - rest[point][axis];
      data.qvel[3 * k + axis] = request.velocities[point][axis];
    }
  });
  for (let i = 0; i < request.steps; ++i) mujoco.mj_step(model, data);
  const positions = rest.map((place) => [...place]);
  const velocities = rest.map(() => [0, 0, 0]);
  free.forEach((point, k) => {
    for (let axis = 0; axis < 3; ++axis) {
      positions[point][axis] += data.qpos[3 * k + axis];
      velocities[point][axis] = data.qvel[3 * k + axis];
    }
  });
  return { positions, velocities };
}

for await (const line of readline.createInterface({ input: process.stdin })) {
  const request = JSON.parse(line);
  const answer = request.points ? compile(request) : advance(request);
  process.stdout.write(JSON.stringify(answer) + '\n');
}
