// SPDX-License-Identifier: Apache-2.0
//! C ABI over Rapier so that the shared C++ driver can time it like the other engines.
#[cfg(feature = "f32")]
use rapier3d as rapier;
#[cfg(feature = "f64")]
use rapier3d_f64 as rapier;
use rapier::prelude::*;

pub struct W { w: PhysicsWorld, h: Vec<RigidBodyHandle> }
type R = Real;

#[repr(C)]
pub struct Body { shape: i32, dynamic: i32, ccd: i32, half: [f64; 3], radius: f64, pos: [f64; 3], rot: [f64; 4], lin: [f64; 3], ang: [f64; 3], density: f64, friction: f64 }

fn v(a: &[f64; 3]) -> Vector { Vector::new(a[0] as R, a[1] as R, a[2] as R) }

#[no_mangle]
pub unsafe extern "C" fn rp_new(g: *const f64, threads: i32, iters: i32, ccd: i32) -> *mut W {
    let mut w = PhysicsWorld::default();
    let g = std::slice::from_raw_parts(g, 3);
    w.gravity = Vector::new(g[0] as R, g[1] as R, g[2] as R);
    if iters > 0 { w.integration_parameters.num_solver_iterations = iters as usize; }
    if ccd == 0 { w.integration_parameters.max_ccd_substeps = 0; }
    w.integration_parameters.normalized_max_linear_velocity = 2000.0;
    let _ = threads;
    #[cfg(feature = "parallel")]
    { w.configure_thread_pool(threads as usize).unwrap(); }
    Box::into_raw(Box::new(W { w, h: vec![] }))
}
#[no_mangle]
pub unsafe extern "C" fn rp_add(p: *mut W, b: *const Body) {
    let (p, b) = (&mut *p, &*b);
    let rot = Rotation::from_xyzw(b.rot[1] as R, b.rot[2] as R, b.rot[3] as R, b.rot[0] as R);
    let pose = Pose::from_parts(v(&b.pos), rot);
    let rb = if b.dynamic != 0 { RigidBodyBuilder::dynamic() } else { RigidBodyBuilder::fixed() };
    let rb = rb.pose(pose).linvel(v(&b.lin)).angvel(v(&b.ang)).can_sleep(false).ccd_enabled(b.ccd != 0);
    let c = if b.shape == 0 { ColliderBuilder::cuboid(b.half[0] as R, b.half[1] as R, b.half[2] as R) } else { ColliderBuilder::ball(b.radius as R) };
    let (h, _) = p.w.insert(rb, c.density(b.density as R).friction(b.friction as R));
    p.h.push(h);
}
#[no_mangle]
pub unsafe extern "C" fn rp_mesh(p: *mut W, vs: *const f64, nv: i32, ti: *const i32, nt: i32, friction: f64, flags: i32) {
    let p = &mut *p;
    let vs = std::slice::from_raw_parts(vs, 3 * nv as usize);
    let ti = std::slice::from_raw_parts(ti, 3 * nt as usize);
    let pts: Vec<Vector> = vs.chunks(3).map(|a| Vector::new(a[0] as R, a[1] as R, a[2] as R)).collect();
    let idx: Vec<[u32; 3]> = ti.chunks(3).map(|a| [a[0] as u32, a[1] as u32, a[2] as u32]).collect();
    let c = if flags == 0 { ColliderBuilder::trimesh(pts, idx).unwrap() } else { ColliderBuilder::trimesh_with_flags(pts, idx, TriMeshFlags::FIX_INTERNAL_EDGES).unwrap() };
    let (h, _) = p.w.insert(RigidBodyBuilder::fixed(), c.friction(friction as R));
    p.h.push(h);
}
#[no_mangle]
pub unsafe extern "C" fn rp_step(p: *mut W, dt: f64) { let p = &mut *p; p.w.integration_parameters.dt = dt as R; p.w.step(); }
#[no_mangle]
pub unsafe extern "C" fn rp_get(p: *mut W, i: i32, o: *mut f64) {
    let p = &*p; let b = &p.w.bodies[p.h[i as usize]]; let o = std::slice::from_raw_parts_mut(o, 13);
    let (t, q, l, a) = (b.position().translation, b.position().rotation, b.linvel(), b.angvel());
    let x = [t.x, t.y, t.z, q.w, q.x, q.y, q.z, l.x, l.y, l.z, a.x, a.y, a.z];
    for k in 0..13 { o[k] = x[k] as f64; }
}
#[no_mangle]
pub unsafe extern "C" fn rp_contacts(p: *mut W) -> i32 {
    let p = &*p;
    p.w.contact_pairs().map(|c| c.manifolds().iter().map(|m| m.points.len()).sum::<usize>()).sum::<usize>() as i32
}
#[no_mangle]
pub unsafe extern "C" fn rp_rays(p: *mut W, o: *const f64, d: *const f64, n: i64, f: *mut f64) -> i64 {
    let p = &*p; let mut h = 0; let n = n as usize;
    let (o, d, f) = (std::slice::from_raw_parts(o, 3 * n), std::slice::from_raw_parts(d, 3 * n), std::slice::from_raw_parts_mut(f, n));
    let q = p.w.query_pipeline();
    for i in 0..n {
        let ray = Ray::new(Vector::new(o[3 * i] as R, o[3 * i + 1] as R, o[3 * i + 2] as R), Vector::new(d[3 * i] as R, d[3 * i + 1] as R, d[3 * i + 2] as R));
        match q.cast_ray(&ray, 1.0, true) { Some((_, t)) => { f[i] = t as f64; h += 1 } None => f[i] = 2.0 }
    }
    h
}
